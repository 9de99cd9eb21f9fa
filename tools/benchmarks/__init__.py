"""Benchmarks: each one is a package whose main function writes one record and regenerates its pages."""
