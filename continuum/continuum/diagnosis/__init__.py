"""Which effect explains what a simulation gets wrong: hypotheses, their evidence, search, confirmation, decision."""
