"""Generators of documentation other than benchmarks: API reference, table of equations, pictures, notebook outputs."""
