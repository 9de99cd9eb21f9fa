"""Cables through a section: lengths from the configuration and back, and the rates between them."""

from continuum.kinematics.cables.eq08_lengths import cable_lengths
from continuum.kinematics.cables.eq09_configuration_from_cables import (
    configuration_cable_jacobian,
    configuration_from_cables,
)
from continuum.kinematics.cables.eq26_rates import cable_jacobian

__all__ = ["cable_jacobian", "cable_lengths", "configuration_cable_jacobian", "configuration_from_cables"]
