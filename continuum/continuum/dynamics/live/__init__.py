"""An arm that is simulated interval by interval while it is commanded, for nodes and emulators; free of clocks."""
