"""Benchmark of discovery: effects hidden by a plant that is independent of the library, and their diagnosis."""
