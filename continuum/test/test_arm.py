"""Geometry of sections and arms: what follows from it, and that a wrong value is refused by name."""

import math
from dataclasses import fields

import pytest
from continuum_laws.labels import label
from continuum_laws.outcomes import outcome
from continuum_laws.samples import PROTOTYPE, SECTIONS, mixed_arm
from continuum_laws.strategies import LAW, arms
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import SECTION_PARAMETERS, Arm, Section, arm_from_mapping, arm_to_mapping
from continuum.errors import InvalidValueError
from continuum.kinematics.cables import cable_lengths
from continuum.kinematics.configuration import allen_from_jones

GOOD = {"sections": ["s"], "s": {"n_joints": 5, "b": 0.02, "a": 0.03}}

BAD_VALUES = {
    "n_joints": [0, -1, 1001, 2.5, True, None, "5", [5], 10**400],
    "b": [0, -0.01, 11.0, math.nan, math.inf, True, "0.02", None, 10**400],
    "a": [0.0, -0.01, 11.0, math.nan, -math.inf, [0.03], {}],
    "twist": [7.0, -7.0, math.nan, "0"],
    "cable_azimuths": ["0, 1, 2", 0.0, None, {}],
    "bend_limit": [0.0, -1.0, 101.0, math.nan, 6.0],
    "link_mass": [0.0, -1.0, 1001.0, math.inf],
    "link_inertia": [0.0, -1.0, 1001.0, math.nan],
}


def with_value(name: str, value: object) -> dict[str, object]:
    return {"sections": ["s"], "s": {**GOOD["s"], name: value}}


def test_names_and_lengths() -> None:
    assert PROTOTYPE.length == pytest.approx(0.1925)
    assert PROTOTYPE.theta_joints == tuple(f"prototype_theta_{k}" for k in range(1, 6))
    assert PROTOTYPE.cable_names == tuple(f"prototype_cable_{j}" for j in range(1, 5))
    assert (PROTOTYPE.phi_joint, PROTOTYPE.phi_back_joint) == ("prototype_phi", "prototype_phi_back")
    assert (PROTOTYPE.base_frame, PROTOTYPE.tip_frame) == ("prototype_base", "prototype_tip")
    arm = mixed_arm(3)
    assert arm.n_sections == 3
    assert arm.length == pytest.approx(sum(section.length for section in arm.sections))
    assert arm.cable_names == sum((section.cable_names for section in arm.sections), ())


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)
def test_a_cable_on_the_inner_side_vanishes_at_the_contact_bend(section: Section) -> None:
    w = allen_from_jones(section.cable_azimuths[1], section.contact_bend)
    assert cable_lengths(w, section)[1] == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in BAD_VALUES.items() for value in values], ids=label
)
def test_a_bad_value_is_refused_by_name(name: str, value: object) -> None:
    with pytest.raises(InvalidValueError) as caught:
        arm_from_mapping(with_value(name, value))
    assert str(caught.value).startswith(f"arm.s.{name} is {value!r}; allowed: ")


@pytest.mark.parametrize("item", [7.0, math.nan, math.inf, "1", None, True])
def test_a_bad_azimuth_is_refused_by_its_place(item: object) -> None:
    with pytest.raises(InvalidValueError, match=r"^arm\.s\.cable_azimuths\[2\] is "):
        arm_from_mapping(with_value("cable_azimuths", [0.0, 1.0, item]))


@pytest.mark.parametrize(
    "azimuths", [[], [0.0], [0.0, 1.0], [0.0, 1.0, 1.0], [0.0, 2.0, 2 * math.pi], [-1.0, 0.0, -1.0, 2.0]]
)
def test_cables_that_cannot_hold_the_section_are_refused(azimuths: list[float]) -> None:
    with pytest.raises(InvalidValueError, match=r"^arm\.s\.cable_azimuths is .*three or more azimuths, all different"):
        arm_from_mapping(with_value("cable_azimuths", azimuths))


def test_bend_limit_beyond_contact_is_refused_with_the_largest_that_is_allowed() -> None:
    limit = Section("s", 5, 0.02, 0.03).contact_bend
    assert Section("s", 5, 0.02, 0.03, bend_limit=limit * (1 - 1e-12)).bend_limit < limit
    with pytest.raises(InvalidValueError, match=rf"less than {limit:.6g} rad"):
        Section("s", 5, 0.02, 0.03, bend_limit=limit)


def test_a_default_that_the_section_does_not_allow_is_reported_to_be_one() -> None:
    short = {"n_joints": 2, "b": 0.01, "a": 0.02}
    output = "it was left out, and this is its default: set it"
    with pytest.raises(InvalidValueError, match=rf"^arm\.s\.bend_limit is 3\.14.* rad, .*; {output}$"):
        arm_from_mapping({"sections": ["s"], "s": short})
    with pytest.raises(InvalidValueError) as caught:
        arm_from_mapping({"sections": ["s"], "s": {**short, "bend_limit": math.pi}})
    assert output not in str(caught.value)


@pytest.mark.parametrize(
    ("mapping", "name"),
    [
        ({}, "arm.sections"),
        ({"sections": []}, "arm.sections"),
        ({"sections": "s", "s": GOOD["s"]}, "arm.sections"),
        ({"sections": ["s", "s"], "s": GOOD["s"]}, "arm.sections"),
        ({"sections": [1], "s": GOOD["s"]}, "arm.sections[0]"),
        ({"sections": ["s"]}, "arm.s"),
        ({"sections": ["s"], "s": [1, 2]}, "arm.s"),
        ({"sections": ["s"], "s": {"n_joints": 5, "b": 0.02}}, "arm.s.a"),
        ({**GOOD, "t": GOOD["s"]}, "arm.t"),
        ({"sections": ["s"], "s": {**GOOD["s"], "radius": 0.1}}, "arm.s.radius"),
        ({"sections": ["s"], "s": {**GOOD["s"], "name": "other"}}, "arm.s.name"),
    ],
)
def test_a_malformed_arm_is_refused_by_name(mapping: dict[str, object], name: str) -> None:
    with pytest.raises(InvalidValueError) as caught:
        arm_from_mapping(mapping)
    assert caught.value.name == name


JUNK = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.binary(max_size=3),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=6,
)


@LAW
@given(name=st.sampled_from([spec.name for spec in SECTION_PARAMETERS]), value=JUNK)
def test_any_value_is_taken_or_refused_by_name(name: str, value: object) -> None:
    found = outcome(arm_from_mapping, with_value(name, value))
    if isinstance(found, InvalidValueError):
        assert found.name.startswith((f"arm.s.{name}", "arm.s.bend_limit"))
        assert repr(found.value) in str(found)
    else:
        assert getattr(found.sections[0], name) == (tuple(value) if isinstance(value, list) else value)


@LAW
@given(mapping=st.dictionaries(st.sampled_from(["sections", "s", "t"]), JUNK | st.just(GOOD["s"]) | st.just(["s"])))
def test_any_mapping_is_an_arm_or_refused(mapping: dict[str, object]) -> None:
    found = outcome(arm_from_mapping, mapping)
    if isinstance(found, InvalidValueError):
        assert found.name.startswith("arm.")
    else:
        assert [section.name for section in found.sections] == mapping["sections"]


@LAW
@given(arm=arms())
def test_mapping_and_back(arm: Arm) -> None:
    assert arm_from_mapping(arm_to_mapping(arm)) == arm


def test_left_out_parameters_take_their_declared_defaults() -> None:
    section = arm_from_mapping(GOOD).sections[0]
    for spec in SECTION_PARAMETERS:
        if spec.default is not None:
            kept = getattr(section, spec.name)
            assert (list(kept) if spec.is_list else kept) == spec.default, spec.name


def test_every_field_of_a_section_is_a_parameter() -> None:
    assert [spec.name for spec in SECTION_PARAMETERS] == [f.name for f in fields(Section) if f.name != "name"]
