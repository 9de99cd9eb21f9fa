"""Machine code of a model's equations and of their exact derivatives."""
