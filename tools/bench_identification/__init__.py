"""How the estimate by smoothing compares with the thesis's particle swarm, and how long a diagnosis takes."""
