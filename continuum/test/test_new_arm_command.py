"""`continuum new-arm`: the file that it writes is the arm that was asked for, and every command takes it."""

import contextlib
import io
import json
import math
from pathlib import Path

import pytest
import yaml
from command_line import Captured, code, refused
from continuum_laws.strategies import LAW
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import SECTION_PARAMETERS, load_arm, prototype_section
from continuum.dynamics.model_file import load_model
from continuum.dynamics.parameters import PARAMETERS
from continuum.dynamics.taken_defaults import TakenDefault
from continuum.parameter_keys import common_name

MEASURED = ("--link-length", 0.03, "--hole-radius", 0.02, "--mass", 0.031)


@pytest.fixture(scope="session")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("new") / "arm.yaml"


def test_without_values_it_is_the_prototype(capsys: Captured, tmp_path: Path) -> None:
    file = tmp_path / "made" / "arm.yaml"
    assert code("new-arm", file) == 0
    assert capsys.readouterr().out.endswith(f"written: {file}\n")
    (section,), expected = load_arm(file).sections, prototype_section()
    for name in ("n_joints", "b", "a", "bend_limit", "link_mass", "link_inertia"):
        assert getattr(section, name) == getattr(expected, name)
    assert sorted(section.cable_azimuths) == sorted(expected.cable_azimuths)


@LAW
@given(
    n_sections=st.integers(1, 4),
    n_joints=st.integers(1, 12),
    length=st.floats(2e-3, 0.2),
    radius=st.floats(1e-3, 0.1),
    mass=st.floats(1e-5, 2.0),
    stiffness=st.none() | st.floats(0.0, 10.0),
)
def test_any_arm_is_read_back(
    scratch: Path, n_sections: int, n_joints: int, length: float, radius: float, mass: float, stiffness: float | None
) -> None:
    words = ("--sections", n_sections, "--joints", n_joints, "--link-length", length, "--hole-radius", radius)
    further = () if stiffness is None else ("--stiffness", stiffness)
    assert code("new-arm", scratch, *words, "--mass", mass, *further, "--force") == 0
    arm = load_arm(scratch)
    assert arm.n_sections == n_sections
    assert arm.length == pytest.approx(n_sections * n_joints * length, rel=1e-12)
    for section in arm.sections:
        assert (section.n_joints, section.b, section.a, section.link_mass) == (n_joints, length / 2, radius, mass)
        assert section.bend_limit < section.contact_bend
        p = load_model(scratch, section.name).parameters
        assert (p.stiffness == (stiffness or 0.0)).all()
        assert p.joint_spacing[0] == pytest.approx(length, rel=1e-12)


def test_every_command_takes_the_file(capsys: Captured, tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    assert code("new-arm", file, *MEASURED, "--sections", 2, "--stiffness", 0.2, "--viscous-friction", 0.002) == 0
    assert code("info", file) == 0
    assert code("solve", file, 0.05, 0, 0.25) == 0
    assert code("simulate", "--model", file, "--section", "section_2", "--release", 40, "--duration", 0.1) == 0
    assert code("simulate", "--model", file, "--release", 40, "--duration", 0.1) == 0  # both, in space
    capsys.readouterr()
    assert "section_1 or section_2" in refused(capsys, "diagnose", "--model", file, "run.csv")


def test_a_file_that_is_there_stays_without_force(capsys: Captured, tmp_path: Path) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text("mine", encoding="utf-8")
    assert "--force" in refused(capsys, "new-arm", file)
    assert file.read_text(encoding="utf-8") == "mine"
    assert code("new-arm", file, "--force") == 0
    assert load_arm(file).n_sections == 1


@pytest.mark.parametrize("left_out", range(0, len(MEASURED), 2))
def test_no_value_of_the_prototype_is_mixed_with_those_of_another_arm(
    capsys: Captured, tmp_path: Path, left_out: int
) -> None:
    words = MEASURED[:left_out] + MEASURED[left_out + 2 :]
    assert str(MEASURED[left_out]) in refused(capsys, "new-arm", tmp_path / "arm.yaml", *words)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("--sections", 0), ("--joints", 0), ("--joints", 1001), ("--link-length", 0), ("--link-length", 30),
        ("--hole-radius", "nan"), ("--mass", -1), ("--mass", 1e-9), ("--inertia", 0), ("--stiffness", -1),
    ],
)  # fmt: skip
def test_a_wrong_value_is_refused_by_its_option(capsys: Captured, tmp_path: Path, option: str, value: object) -> None:
    line = refused(capsys, "new-arm", tmp_path / "arm.yaml", *MEASURED, option, value)
    assert line.startswith(f"{option} is ")
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_no_command_would_take_is_not_written(capsys: Captured, tmp_path: Path) -> None:
    assert "NAME.yaml" in refused(capsys, "new-arm", tmp_path / "arm.txt")


DEFAULTS = [spec.name for spec in SECTION_PARAMETERS if spec.default is not None]
DYNAMIC_DEFAULTS = [
    name for name in PARAMETERS if PARAMETERS[name].default is not None and PARAMETERS[name].symbol != "m"
]


@given(given_keys=st.sets(st.sampled_from(DEFAULTS)), dynamic=st.sets(st.sampled_from(DYNAMIC_DEFAULTS)))
def test_info_lists_the_defaults_that_were_taken_and_no_others(
    scratch: Path, given_keys: set[str], dynamic: set[str]
) -> None:
    """All of those of a section; and of its block `dynamics`, where there is one."""
    values = {"twist": 0.1, "cable_azimuths": [0.0, math.pi, 1.0], "bend_limit": 1.0}
    values |= {"link_mass": 0.03, "link_inertia": 5e-6}
    section: dict[str, object] = {"n_joints": 5, "b": 0.015, "a": 0.02, **{key: values[key] for key in given_keys}}
    whole = given_keys >= {"cable_azimuths", "link_mass", "link_inertia"}
    if whole:
        section["dynamics"] = {"center_of_mass": 0.01, **{name: PARAMETERS[name].another_value for name in dynamic}}
    scratch.write_text(yaml.safe_dump({"arm": {"sections": ["s"], "s": section}}), encoding="utf-8")
    taken = {one.name: one for one in taken_by_info(scratch)}
    expected = {common_name(name) for name in {*DEFAULTS} - given_keys}
    if whole:
        expected |= {f"dynamics.{name}" for name in {*DYNAMIC_DEFAULTS} - dynamic}
    assert taken.keys() == expected
    for name, one in taken.items():
        assert one.other_size == (name in ("mass", "inertia")) == one.of_prototype
        first, _, rest = name.partition(".")
        if rest:
            assert one.value == load_model(scratch).values()[rest][0]
        else:
            (spec,) = (spec for spec in SECTION_PARAMETERS if common_name(spec.name) == first)
            kept = getattr(load_arm(scratch).sections[0], spec.name)
            assert one.value == (list(kept) if isinstance(kept, tuple) else kept)


def taken_by_info(file: Path) -> list[TakenDefault]:
    """As `info --json` has them."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        assert code("info", file, "--json") == 0
    return [TakenDefault(**one) for one in json.loads(printed.getvalue())["defaults"]]


@pytest.mark.parametrize(("b", "a", "warned"), [(0.01925, 0.032, False), (0.015, 0.032, True), (0.01925, 0.02, True)])
def test_a_mass_of_links_of_another_size_is_a_warning(
    capsys: Captured, tmp_path: Path, b: float, a: float, warned: bool
) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(f"sections: [s]\ns: {{n_joints: 5, b: {b}, a: {a}, bend_limit: 1.0}}\n", encoding="utf-8")
    assert code("info", file) == 0
    lines = capsys.readouterr().out.splitlines()
    assert any(line.startswith("  mass: 0.22257 kg") for line in lines)
    assert any(line.startswith("warning: mass") for line in lines) == warned
