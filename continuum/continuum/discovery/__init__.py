"""Which effect explains what a simulation gets wrong: hypotheses, their evidence, search, confirmation, decision."""

from continuum.discovery.diagnosis import diagnose
from continuum.discovery.result import Diagnosis

__all__ = ["Diagnosis", "diagnose"]
