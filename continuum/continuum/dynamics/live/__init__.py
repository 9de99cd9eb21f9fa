"""Simulation of an arm interval by interval under commands, for nodes and emulators; independent of any clock."""
