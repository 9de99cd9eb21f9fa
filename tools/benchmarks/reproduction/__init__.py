"""The thesis's published results of its dynamic model, made again: `make reproduction`."""
