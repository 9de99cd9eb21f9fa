"""One section of constant curvature: configuration to pose and back, and the rates between them."""

from continuum.kinematics.section.eq04_pose import section_pose, section_position, section_rotation
from continuum.kinematics.section.eq05_configuration_from_point import configuration_from_point
from continuum.kinematics.section.eq21_jacobian import section_jacobian, spatial_twist_jacobian
from continuum.kinematics.section.eq22_rates_from_point import (
    configuration_from_point_jacobian,
    jones_from_point_jacobian,
)

__all__ = [
    "configuration_from_point",
    "configuration_from_point_jacobian",
    "jones_from_point_jacobian",
    "section_jacobian",
    "section_pose",
    "section_position",
    "section_rotation",
    "spatial_twist_jacobian",
]
