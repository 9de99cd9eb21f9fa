"""Check of the workspace with the versions of Ubuntu 24.04, in a second checkout below out/."""
