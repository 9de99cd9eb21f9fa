"""Configuration of a section: Allen's (u, v), Jones's (phi, kappa, s) and the bend theta between them.

Everywhere in the library ``w`` is Allen's pair (u, v) [rad], the x and y parts of the section's rotation vector: it is
regular in the straight posture, where Jones's azimuth phi is not defined.
"""

from continuum.kinematics.configuration.eq01_allen_and_jones import allen_from_jones, bend, jones_from_allen
from continuum.kinematics.configuration.eq06_arc import arc_length, curvature
from continuum.kinematics.configuration.eq23_allen_rates import allen_rate_jacobian, allen_rates, jones_rates
from continuum.kinematics.configuration.eq24_arc_rates import arc_rates

__all__ = [
    "allen_from_jones",
    "allen_rate_jacobian",
    "allen_rates",
    "arc_length",
    "arc_rates",
    "bend",
    "curvature",
    "jones_from_allen",
    "jones_rates",
]
