"""How often the intervals of `continuum curvature` hold the true joint angles, on arms of which these are known."""
