"""Diagnosis of the prototype from its only published run."""
