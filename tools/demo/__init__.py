"""`make demo`: real nodes follow a trajectory, by default the helix of thesis 4.1, and the run is evaluated."""
