"""Coverage of the intervals of `continuum curvature` on arms with known joint angles."""
