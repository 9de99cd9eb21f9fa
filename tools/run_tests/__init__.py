"""Run every test: what starts nodes alone, what only computes on all cores."""
