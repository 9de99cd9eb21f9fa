"""Nodes of a multi-section snake arm; what every node of the workspace shares is in :mod:`nodekit`."""
