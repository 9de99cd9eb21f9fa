"""The parameter files of the package describe the trajectories that they say."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
import yaml
from scipy.spatial.transform import Rotation

from trajectory_generator.from_parameters import trajectory_from_mapping
from trajectory_generator.parameters import PATH_PARAMETERS, parameters_of

CONFIG = Path(__file__).parents[1] / "config"


def flat(block: Mapping[str, object], prefix: str = "") -> Iterator[tuple[str, object]]:
    """Parameters by the names that ROS gives them."""
    for name, value in block.items():
        if isinstance(value, Mapping):
            yield from flat(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value


def parameters(file: str) -> dict[str, object]:
    return dict(flat(yaml.safe_load((CONFIG / file).read_text(encoding="utf-8"))["/**"]["ros__parameters"]))


@pytest.mark.parametrize("file", sorted(file.name for file in CONFIG.glob("*.yaml") if "path" in parameters(file.name)))
def test_every_file_makes_a_trajectory_and_keeps_types_apart(file: str) -> None:
    values = parameters(file)
    assert trajectory_from_mapping(values).duration > 5.0
    kinds = {spec.name: spec.kind for spec in parameters_of(values["path"])}
    for name, value in values.items():
        for item in value if isinstance(value, list) else [value]:
            assert type(item) is kinds[name], f"ROS reads {name}: {item!r} as another type than it is declared with"


def test_helix_files_are_those_of_the_thesis() -> None:
    ours, original = parameters("helix.yaml"), parameters("helix_original.yaml")
    assert {name: ours[name] for name in ours if name.startswith(("helix", "max"))} == {
        "helix.radius": 0.15,
        "helix.pitch": 0.08,
        "helix.z_start": 0.01,
        "helix.z_end": 0.30,
        "helix.n_points": 301,
        "max_speed": 0.1,
        "max_acceleration": 0.02,
    }
    assert (original["corner_radius"], original["lead_time"], original["rate"]) == (0.02, 10.0, 20.0)


def test_defaults_are_the_helix_of_the_thesis() -> None:
    assert trajectory_from_mapping({}).duration == trajectory_from_mapping(parameters("helix.yaml")).duration


def test_roll_pitch_yaw_are_about_fixed_axes_and_equal_a_quaternion() -> None:
    roll, pitch, yaw = 0.3, -0.5, 1.2
    about = {axis: Rotation.from_euler(axis, angle) for axis, angle in zip("xyz", (roll, pitch, yaw), strict=True)}
    quaternion = (about["z"] * about["y"] * about["x"]).as_quat().tolist()
    line = {"path": "line", "line.start": [0.0, 0.0, 0.0], "line.end": [1.0, 0.0, 0.0]}
    via = {"path": "via_points", "via_points.form": "xyz_quaternion"}
    for values in (
        {**line, "line.start_rpy": [roll, pitch, yaw]},
        {**via, "via_points.list": [0.0, 0.0, 0.0, *quaternion, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]},
    ):
        assert trajectory_from_mapping(values).sample(0.0).quaternion == pytest.approx(quaternion)
        assert trajectory_from_mapping(values).sample(1e6).quaternion == pytest.approx([0, 0, 0, 1])


def test_every_parameter_is_described_and_its_default_allowed() -> None:
    for kind in PATH_PARAMETERS:
        specs = parameters_of(kind)
        assert len({spec.name for spec in specs}) == len(specs)
        for spec in specs:
            assert len(spec.description) > 8
            assert spec.default is None or spec.check(spec.default) == spec.default
