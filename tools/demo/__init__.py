"""`make demo`: real nodes follow a trajectory, the helix of thesis 4.1 if no other is given, and the run is judged."""
