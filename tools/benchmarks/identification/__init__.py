"""How the library's identification compares with the thesis's particle swarm, on arms whose truth is known."""
