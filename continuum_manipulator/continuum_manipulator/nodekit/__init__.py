"""Common parts of all nodes: parameters, checked messages, reports of faults, diagnostics and a clean exit."""
