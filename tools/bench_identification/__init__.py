"""How the fit by slopes compares with the thesis's particle swarm, and how long a diagnosis takes."""
