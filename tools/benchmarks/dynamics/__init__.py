"""The integrators measured against each other: `make bench-dynamics`."""
