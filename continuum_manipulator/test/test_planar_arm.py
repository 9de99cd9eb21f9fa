"""The section of a planar arm: that of an arm file, or the given one."""

from copy import deepcopy
from pathlib import Path

import pytest
import yaml

from continuum.errors import InvalidValueError
from continuum_manipulator.dynamics import DynamicsNode
from continuum_manipulator.nodekit.planar_arm import PlanarArm

SECTION = {
    "n_joints": 2, "b": 0.015, "a": 0.02, "bend_limit": 1.0, "cable_azimuths_deg": [0.0, 180.0, 90.0], "mass": 0.03,
    "inertia": 5e-6, "dynamics": {"center_of_mass": 0.01},
}  # fmt: skip


def values(folder: Path, names: list[str], **given: str) -> dict[str, object]:
    """Values of the node's parameters, with an arm file of sections with these names."""
    file = folder / "arm.yaml"
    file.write_text(yaml.safe_dump({"arm": {"sections": names, **{name: deepcopy(SECTION) for name in names}}}))
    defaults = {spec.name: spec.default for spec in DynamicsNode.PARAMETERS}
    return defaults | {"model": str(file)} | given


@pytest.mark.parametrize(
    ("names", "given", "expected"),
    [(["s1"], {}, "s1"), (["s1"], {"section": "s1"}, "s1"), (["s", "t"], {"section": "t"}, "t")],
)
def test_of_an_arm_file_it_is_the_only_section_or_the_given_one(
    tmp_path: Path, names: list[str], given: dict[str, str], expected: str
) -> None:
    arm = PlanarArm.of_parameters(values(tmp_path, names, **given))
    assert (arm.section, arm.cables) == (expected, [f"{expected}_cable_1", f"{expected}_cable_2"])


@pytest.mark.parametrize(("given", "expected"), [({}, "section_1"), ({"section": "elbow"}, "elbow")])
def test_a_model_file_names_none(tmp_path: Path, given: dict[str, str], expected: str) -> None:
    arm = PlanarArm.of_parameters(values(tmp_path, ["s1"], model="lamecc_prototype.yaml", **given))
    assert arm.section == expected


@pytest.mark.parametrize(("names", "given"), [(["s", "t"], {}), (["s"], {"section": "section_1"})])
def test_a_section_that_is_not_there_is_refused_by_the_parameter(
    tmp_path: Path, names: list[str], given: dict[str, str]
) -> None:
    with pytest.raises(InvalidValueError, match=r"section is .*which `section` names") as refused:
        PlanarArm.of_parameters(values(tmp_path, names, **given))
    assert "--" not in str(refused.value)
