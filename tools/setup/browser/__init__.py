"""A browser for the tests of the viewer, in out/browser: nothing is installed on the machine."""
