"""Benchmark of discovery: effects hidden by a plant that the library does not know, and what the diagnosis says."""
