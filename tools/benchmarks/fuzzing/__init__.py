"""Random, mutated and coverage-guided bytes through both parsers of the bench protocol."""
