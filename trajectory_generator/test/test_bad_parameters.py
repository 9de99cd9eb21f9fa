"""Whatever a parameter is set to, there is a trajectory or an InvalidValueError that names the parameter."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum.errors import InvalidValueError
from trajectory_generator.circle import circle_path
from trajectory_generator.from_parameters import trajectory_from_mapping
from trajectory_generator.line import line_path
from trajectory_generator.parameters import PATH_PARAMETERS, VIA_POINT_FORMS, parameters_of
from trajectory_generator.rounded_path import rounded_path

NAMES = sorted({spec.name for kind in PATH_PARAMETERS for spec in parameters_of(kind)} - {"path"})

floats = st.floats(allow_nan=True, allow_infinity=True)
# Figures that fit now and then, so that a path is made of them, and coincide now and then.
coarse = st.integers(-20, 20).map(lambda n: n / 20)
anything = (
    floats | coarse | st.integers(-10, 10**9) | st.text(max_size=8) | st.booleans() | st.none()
    | st.lists(floats | coarse, max_size=9) | st.sampled_from(list(VIA_POINT_FORMS))
)  # fmt: skip


def make(values: dict[str, object]) -> None:
    """Make the trajectory and use it: all that comes out must be finite."""
    trajectory = trajectory_from_mapping(values)
    sample = trajectory.sample(np.linspace(0, trajectory.duration, 11))
    for figures in (sample.position, sample.quaternion, sample.linear_velocity, sample.angular_velocity):
        assert np.all(np.isfinite(figures))


def make_or_refuse(values: dict[str, object]) -> None:
    try:
        make(values)
    except InvalidValueError as error:
        message = str(error)
    else:
        return
    assert "allowed: " in message
    assert "\n" not in message


@settings(deadline=None)
@given(st.sampled_from([*PATH_PARAMETERS]), st.dictionaries(st.sampled_from(NAMES), anything, max_size=6))
def test_any_value_of_any_parameter(path: str, values: dict[str, object]) -> None:
    known = {spec.name for spec in parameters_of(path)}
    make_or_refuse({"path": path, **{name: value for name, value in values.items() if name in known}})


@settings(deadline=None)
@given(
    st.lists(st.tuples(*[coarse] * 6), min_size=0, max_size=6),
    st.floats(1e-3, 0.3),
    st.floats(1e-3, 1.0),
)
def test_any_coarse_via_points(points: list[tuple[float, ...]], corner_radius: float, equivalent_radius: float) -> None:
    make_or_refuse(
        {
            "path": "via_points",
            "via_points.form": "xyz_rpy",
            "via_points.list": [figure for point in points for figure in point],
            "corner_radius": corner_radius,
            "equivalent_radius": equivalent_radius,
        }
    )


@settings(deadline=None)
@given(st.lists(coarse, min_size=9, max_size=9), st.floats(1e-6, 1e4))
def test_any_coarse_circle(figures: list[float], angle: float) -> None:
    points = {f"circle.{name}": figures[3 * i : 3 * i + 3] for i, name in enumerate(("start", "center", "toward"))}
    make_or_refuse({"path": "circle", "circle.angle": angle, **points})


SQUARE = [0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.1, 0.1, 0.0]
BAD = {
    "kind": ({"path": "spiral"}, "path is 'spiral'; allowed: one of helix, via_points, line, circle"),
    "unknown": ({"helix.raduis": 1.0}, "helix.raduis is 1.0; allowed: no parameter of this name; known for this path:"),
    "of another path": ({"path": "line", "helix.radius": 1.0}, "helix.radius is 1.0; allowed: no parameter"),
    "flat helix": ({"helix.z_end": 0.01}, "helix.z_end is 0.01; allowed: a height other than z_start"),
    "tight corner": (
        {"corner_radius": 0.16},
        r"corner_radius is 0.16; allowed: less than 0.150973 m: the distance from via_points",
    ),
    "missing": ({"path": "line"}, "line.start is None; allowed: a list"),
    "no way": ({"path": "line", "line.start": SQUARE[:3], "line.end": SQUARE[:3]}, "line.end is .* from the start"),
    "too few figures": ({"path": "line", "line.start": [0.0, 1.0], "line.end": SQUARE[:3]}, "line.start is .* of 2"),
    "angles": ({"path": "line", "line.start": [], "line.end": [], "line.end_rpy": [1.0]}, "line.end_rpy is .* of 1"),
    "on the axis": (
        {"path": "circle", "circle.start": [1.0, 0.0, 0.0], "circle.center": SQUARE[:3], "circle.toward": [2.0, 0, 0]},
        "circle.toward is .* off the line",
    ),
    "no radius": (
        {"path": "circle", "circle.start": SQUARE[:3], "circle.center": SQUARE[:3], "circle.toward": [2.0, 0, 0]},
        "circle.start is .* from the center",
    ),
    "one point": ({"path": "via_points", "via_points.list": [0.0] * 3}, "via_points.list is .* two or more points"),
    "ragged": ({"path": "via_points", "via_points.list": [0.0] * 7}, r"via_points.list is .* 3 figures \(xyz\)"),
    "coincide": (
        {"path": "via_points", "via_points.list": [*SQUARE, *SQUARE[-3:]]},
        r"via_points\[3\] is \[0.1, 0.1, 0.0\]; .* from via_points\[2\]",
    ),
    "folds back": (
        {"path": "via_points", "via_points.list": [*SQUARE, 0.1, 0.05, 0.0], "corner_radius": 0.001},
        r"via_points\[2\] is .* fold back",
    ),
    "no quaternion": (
        {"path": "via_points", "via_points.form": "xyz_quaternion", "via_points.list": [*[0.0] * 6, 1.0, *[1.0] * 7]},
        r"via_points.list \(point 1\) is .* quaternion",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_what_is_wrong_is_said(name: str) -> None:
    values, message = BAD[name]
    with pytest.raises(InvalidValueError, match=message):
        make(values)


def test_library_refuses_what_is_no_rotation_and_no_point() -> None:
    mirror = np.diag([1.0, 1.0, -1.0])
    with pytest.raises(InvalidValueError, match="end_rotation"):
        line_path((0, 0, 0), (1, 0, 0), np.eye(3), mirror, 0.1)
    with pytest.raises(InvalidValueError, match="equivalent_radius"):
        line_path((0, 0, 0), (1, 0, 0), np.eye(3), np.eye(3), 0.0)
    with pytest.raises(InvalidValueError, match=r"start\[1\] is nan"):
        line_path((0, float("nan"), 0), (1, 0, 0), np.eye(3), np.eye(3), 0.1)
    with pytest.raises(InvalidValueError, match="angle"):
        circle_path((1, 0, 0), (0, 0, 0), (0, 1, 0), -1.0, np.eye(3), np.eye(3), 0.1)
    with pytest.raises(InvalidValueError, match="2 positions, 3 rotations"):
        rounded_path([(0, 0, 0), (1, 0, 0)], [np.eye(3)] * 3, 0.1, 0.1)
    with pytest.raises(InvalidValueError, match="via_points is"):
        rounded_path("nowhere", [np.eye(3)] * 3, 0.1, 0.1)


def test_rate_is_checked() -> None:
    with pytest.raises(InvalidValueError, match="rate is 0"):
        trajectory_from_mapping({"rate": 0.0})
    with pytest.raises(InvalidValueError, match=r"rate is 1000000\.0; allowed: less than"):
        trajectory_from_mapping({}).times(1e6)
