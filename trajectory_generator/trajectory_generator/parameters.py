"""The parameters of a trajectory by their ROS names, with type, unit, range, default and description."""

from __future__ import annotations

import math

from continuum.parameter_spec import ParameterSpec
from trajectory_generator.helix import MOST_POINTS

ORIGIN = [0.0, 0.0, 0.0]

VIA_POINT_FORMS = {"xyz": 3, "xyz_rpy": 6, "xyz_quaternion": 7}
"""Number of values of one via point in each form of the list."""


def _point(name: str, description: str, default: list[float] | None = None) -> ParameterSpec:
    return ParameterSpec(name, float, f"{description}: x, y, z", "m", -1e3, 1e3, is_list=True, default=default)


def _orientation(name: str, description: str) -> ParameterSpec:
    words = f"{description}: roll, pitch, yaw about the fixed axes"
    return ParameterSpec(name, float, words, "rad", -100.0, 100.0, is_list=True, default=ORIGIN)


def _positive(name: str, description: str, unit: str, upper: float, default: float) -> ParameterSpec:
    return ParameterSpec(name, float, description, unit, 1e-6, upper, default=default)


_CORNER_RADIUS = _positive("corner_radius", "radius of the arcs that round the corners at via points", "m", 1e3, 0.14)

PATH_PARAMETERS: dict[str, tuple[ParameterSpec, ...]] = {
    "helix": (
        _positive("helix.radius", "distance of the helix from the z axis", "m", 1e3, 0.15),
        _positive("helix.pitch", "rise of the helix per revolution", "m", 1e3, 0.08),
        ParameterSpec("helix.z_start", float, "height of the first via point", "m", -1e3, 1e3, default=0.01),
        ParameterSpec("helix.z_end", float, "height of the last via point", "m", -1e3, 1e3, default=0.30),
        ParameterSpec(
            "helix.n_points", int, "number of via points, both ends included", "", 2, MOST_POINTS, default=301
        ),
        _CORNER_RADIUS,
    ),
    "via_points": (
        ParameterSpec(
            "via_points.form", str, "values of one via point", default="xyz", choices=tuple(VIA_POINT_FORMS)
        ),
        ParameterSpec(
            "via_points.list", float, "values of all via points, in order", "m, rad", -1e3, 1e3,
            is_list=True,
        ),
        _CORNER_RADIUS,
    ),
    "line": (
        _point("line.start", "first point"),
        _point("line.end", "last point"),
        _orientation("line.start_rpy", "orientation at the start"),
        _orientation("line.end_rpy", "orientation at the end"),
    ),
    "circle": (
        _point("circle.start", "first point"),
        _point("circle.center", "centre of the circle"),
        _point("circle.toward", "any point of the circle's plane on the side towards which the motion starts"),
        _positive("circle.angle", "angle of the arc; more than one revolution is allowed", "rad", 1e4, 2 * math.pi),
        _orientation("circle.start_rpy", "orientation at the start"),
        _orientation("circle.end_rpy", "orientation at the end"),
    ),
}  # fmt: skip
"""Parameters of every kind of path, in addition to ``MOTION_PARAMETERS``."""

PATH = ParameterSpec("path", str, "kind of path", default="helix", choices=tuple(PATH_PARAMETERS))

MOTION_PARAMETERS: tuple[ParameterSpec, ...] = (
    _positive("equivalent_radius", "path length that one radian of rotation counts as", "m", 1e3, 0.002),
    _positive("max_speed", "largest speed along the path", "m/s", 1e3, 0.1),
    _positive("max_acceleration", "largest acceleration along the path", "m/s2", 1e6, 0.02),
    ParameterSpec("lead_time", float, "rest at the start before the motion", "s", 0.0, 1e5, default=1.0),
    ParameterSpec("rest_time", float, "rest at the end after the motion", "s", 0.0, 1e5, default=1.0),
    ParameterSpec("rate", float, "poses and twists per second", "Hz", 1e-3, 1e4, default=120.0),
)
"""Parameters of every trajectory, independent of its path."""


def parameters_of(path: object) -> tuple[ParameterSpec, ...]:
    """Return all parameters of a trajectory with the kind ``path`` of path, starting with the kind.

    Raises:
        InvalidValueError: the kind is unknown.
    """
    return (PATH, *MOTION_PARAMETERS, *PATH_PARAMETERS[str(PATH.check(path))])
