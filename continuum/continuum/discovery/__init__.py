"""Diagnosis of a simulation's errors by missing effects: hypotheses, their evidence, search and decision.

Public: `diagnose`, `Diagnosis`, `parameter_fit.fit_parameters`, `words.verdict_in_words`, `words.estimate_in_words`,
`report.write_report`.
"""

from continuum.discovery.diagnosis import diagnose
from continuum.discovery.result import Diagnosis

__all__ = ["Diagnosis", "diagnose"]
