"""Comparison of the library's identification with the thesis's particle swarm, on arms with known parameters."""
