"""Nodes of a multi-section snake arm; :mod:`nodekit` contains the parts that all nodes of the workspace share."""
