"""What every node of the workspace shares: parameters, checked messages, faults told once, diagnostics, clean exit."""
