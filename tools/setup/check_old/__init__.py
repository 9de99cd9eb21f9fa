"""The workspace with the versions of Ubuntu 24.04: set up a second time below out/, and tried."""
