"""A browser for the tests of the viewer, kept in out/browser: nothing is installed on the machine itself."""
