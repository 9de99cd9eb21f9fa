"""Create a trajectory from named parameters of a node or a file."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from continuum.arrays import Array
from continuum.errors import InvalidValueError
from trajectory_generator.checked_arrays import finite_array
from trajectory_generator.circle import circle_path
from trajectory_generator.helix import helix_points
from trajectory_generator.line import line_path
from trajectory_generator.parameters import PATH, VIA_POINT_FORMS, parameters_of
from trajectory_generator.path import Path
from trajectory_generator.rounded_path import rounded_path
from trajectory_generator.trajectory import Trajectory

Checked = dict[str, Any]
"""Values by parameter name, each of the type of its :class:`ParameterSpec`."""


def trajectory_from_mapping(values: Mapping[str, object]) -> Trajectory:
    """Return the trajectory that ``values`` describe, by the flat names of :func:`parameters_of`, with defaults.

    ``rate`` is only checked here; the caller publishes at this rate, since a trajectory can be sampled at any instant.

    Raises:
        InvalidValueError: a parameter is missing, unknown for this kind of path or out of range, or the parameters do
            not describe a path; the message names the parameter.
    """
    checked = _checked(values)
    path = _PATHS[checked["path"]](checked)
    limits = ("max_speed", "max_acceleration", "lead_time", "rest_time")
    return Trajectory(path, **{name: checked[name] for name in limits})


def _checked(values: Mapping[str, object]) -> Checked:
    specs = {spec.name: spec for spec in parameters_of(values.get("path", PATH.default))}
    for name in values:
        if name not in specs:
            known = ", ".join(specs)
            raise InvalidValueError(name, values[name], f"no parameter of this name; known for this path: {known}")
    return {name: spec.check(values.get(name, spec.default)) for name, spec in specs.items()}


@contextmanager
def _named_under(prefix: str) -> Iterator[None]:
    """Add ``prefix`` to the name in errors of the context."""
    try:
        yield
    except InvalidValueError as error:
        raise InvalidValueError(prefix + error.name, error.value, error.allowed) from None


def _helix(values: Checked) -> Path:
    names = ("radius", "pitch", "z_start", "z_end", "n_points")
    with _named_under("helix."):
        points = helix_points(**{name: values[f"helix.{name}"] for name in names})
    upright = np.broadcast_to(np.eye(3), (len(points), 3, 3))
    return rounded_path(points, upright, values["corner_radius"], values["equivalent_radius"])


def _via_points(values: Checked) -> Path:
    figures, form = values["via_points.list"], values["via_points.form"]
    width = VIA_POINT_FORMS[form]
    if len(figures) % width or len(figures) < 2 * width:
        raise InvalidValueError(
            "via_points.list", f"a list of {len(figures)}", f"{width} figures ({form}) for each of two or more points"
        )
    rows = np.reshape(figures, (-1, width))
    rotations = _rotations(rows[:, 3:], "via_points.list")
    return rounded_path(rows[:, :3], rotations, values["corner_radius"], values["equivalent_radius"])


def _line(values: Checked) -> Path:
    start, end = _both_ends(values, "line.")
    with _named_under("line."):
        return line_path(values["line.start"], values["line.end"], start, end, values["equivalent_radius"])


def _circle(values: Checked) -> Path:
    points = {name: values[f"circle.{name}"] for name in ("start", "center", "toward")}
    start, end = _both_ends(values, "circle.")
    with _named_under("circle."):
        return circle_path(
            **points,
            angle=values["circle.angle"],
            start_rotation=start,
            end_rotation=end,
            equivalent_radius=values["equivalent_radius"],
        )


_PATHS: dict[str, Callable[[Checked], Path]] = {
    "helix": _helix,
    "via_points": _via_points,
    "line": _line,
    "circle": _circle,
}


def _both_ends(values: Checked, prefix: str) -> tuple[Array, Array]:
    """Return the orientations (3, 3) at the start and at the end."""
    ends = [finite_array(name, values[name], (3,)) for name in (prefix + "start_rpy", prefix + "end_rpy")]
    start, end = _rotations(np.stack(ends), prefix)
    return start, end


def _rotations(figures: Array, name: str) -> Array:
    """Return rotation matrices (n, 3, 3) from empty rows, roll, pitch, yaw [rad], or quaternions x, y, z, w."""
    if figures.shape[1] == 0:
        return np.broadcast_to(np.eye(3), (len(figures), 3, 3))
    if figures.shape[1] == 3:
        turned: Array = Rotation.from_euler("xyz", figures).as_matrix()
        return turned
    for i in np.flatnonzero(np.abs(np.linalg.norm(figures, axis=1) - 1) > 1e-3):
        raise InvalidValueError(
            f"{name} (point {i})", figures[i].tolist(), "a quaternion x, y, z, w of length 1 to 1e-3"
        )
    matrices: Array = Rotation.from_quat(figures).as_matrix()
    return matrices
