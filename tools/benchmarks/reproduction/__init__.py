"""Reproduction of the published results of the thesis's dynamic model: `make reproduction`."""
