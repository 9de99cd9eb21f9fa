"""Processor load of the viewer, and its effect on other nodes."""
