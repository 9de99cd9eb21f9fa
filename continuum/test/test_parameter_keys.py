"""Two names of one quantity and keys with units: the same values whatever the keys; never two keys for one quantity."""

import math
from pathlib import Path

import numpy as np
import pytest
import yaml
from continuum_laws.outcomes import outcome
from continuum_laws.strategies import LAW, arms
from dynamics_laws import random_model
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import SECTION_UNITS, Arm, arm_from_mapping, arm_to_mapping, load_arm
from continuum.dynamics.model_file import load_model, model_from_mapping, save_model
from continuum.errors import InvalidValueError
from continuum.parameter_keys import known_keys, units_for

PAIRS = {"b": "half_spacing", "a": "hole_radius", "link_mass": "mass", "link_inertia": "inertia"}
IN_UNIT = {"mm": 1e-3, "g": 1e-3, "deg": math.pi / 180}
SECTION = {"n_joints": 5, "b": 0.02, "a": 0.03}


def arm_of(**values: object) -> Arm:
    return arm_from_mapping({"sections": ["s"], "s": values})


def scaled(value: object, factor: float) -> object:
    return [one / factor for one in value] if isinstance(value, list) else value / factor  # type: ignore[operator]


@LAW
@given(arm=arms(), names=st.sets(st.sampled_from(sorted(PAIRS))))
def test_other_names_give_the_same_arm(tmp_path_factory: pytest.TempPathFactory, arm: Arm, names: set[str]) -> None:
    content = arm_to_mapping(arm)
    for section in arm.sections:
        block = content[section.name]
        content[section.name] = {PAIRS[key] if key in names else key: value for key, value in block.items()}  # type: ignore[attr-defined]
    file = tmp_path_factory.getbasetemp() / "renamed.yaml"
    file.write_text(yaml.safe_dump({"arm": content}), encoding="utf-8")
    assert arm_from_mapping(content) == load_arm(file) == arm


@LAW
@given(arm=arms(), data=st.data())
def test_values_in_other_units_are_the_same_quantities(arm: Arm, data: st.DataObject) -> None:
    """Of all keys that are known, lists among them."""
    content = arm_to_mapping(arm)
    for section in arm.sections:
        block: dict[str, object] = {}
        for name, value in content[section.name].items():  # type: ignore[attr-defined]
            unit = data.draw(st.sampled_from(["", *units_for(SECTION_UNITS[name])[1:]]))
            key = data.draw(st.sampled_from([name, PAIRS.get(name, name)]))
            block[f"{key}_{unit}" if unit else key] = scaled(value, IN_UNIT[unit]) if unit else value
        content[section.name] = block
    for found, section in zip(arm_from_mapping(content).sections, arm.sections, strict=True):
        for name in SECTION_UNITS:
            np.testing.assert_allclose(getattr(found, name), getattr(section, name), rtol=1e-14)


@given(degrees=st.floats(-360.0, 360.0))
def test_degrees_are_radians(degrees: float) -> None:
    written = arm_of(**SECTION, twist_deg=degrees), arm_of(**SECTION, twist=math.radians(degrees))
    assert written[0] == written[1]


@given(tenths=st.integers(1, 2000))
def test_decimal_millimetres_are_the_nearest_metres(tenths: int) -> None:
    """As a ruler reads them: 19.2 mm are 0.0192 m to the last digit."""
    section = arm_of(n_joints=5, half_spacing_mm=tenths / 10, a=1e-5).sections[0]
    assert section.b == float(f"{tenths}e-4")


@pytest.mark.parametrize(
    ("short", "further"), [*((short, "") for short in PAIRS), ("b", "_mm"), ("a", "_mm"), ("link_mass", "_g")]
)
def test_two_keys_for_one_quantity_are_refused_by_both(short: str, further: str) -> None:
    long = PAIRS[short] + further
    for first, second in ((short, long), (long, short)):
        others = {key: value for key, value in SECTION.items() if key != short}
        with pytest.raises(InvalidValueError) as caught:
            arm_of(**others, **{first: 0.02, second: 0.02})
        assert caught.value.name == f"arm.s.{second}"
        assert f"arm.s.{first} " in str(caught.value)


@pytest.mark.parametrize(
    ("key", "value", "name", "shown"),
    [
        ("twist_deg", 500.0, "twist_deg", 500.0),
        ("cable_azimuths_deg", [0.0, 90.0, 999.0], "cable_azimuths_deg[2]", 999.0),
        ("bend_limit_deg", 355.0, "bend_limit_deg", 355.0),
        ("mass_g", "30", "mass_g", "30"),
        ("mass", -1.0, "mass", -1.0),
        ("half_spacing_mm", 20000, "half_spacing_mm", 20000),
    ],
)
def test_an_error_has_the_key_and_the_value_of_the_file(key: str, value: object, name: str, shown: object) -> None:
    given_block = {k: v for k, v in SECTION.items() if k != "b" or not key.startswith("half")}
    with pytest.raises(InvalidValueError) as caught:
        arm_of(**given_block, **{key: value})
    assert (caught.value.name, caught.value.value) == (f"arm.s.{name}", shown)


JUNK = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.just(10**400),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=6,
)


@LAW
@given(
    block=st.dictionaries(st.sampled_from([*known_keys(SECTION_UNITS), "twist_mm", "deg", "_deg", "b_"]), JUNK),
    whole=st.booleans(),
)
def test_any_block_is_an_arm_or_refused_by_a_key_that_it_has_or_lacks(block: dict[str, object], whole: bool) -> None:
    content = SECTION | block if whole else block
    found = outcome(lambda: arm_of(**content))
    if isinstance(found, InvalidValueError):
        key = found.name.removeprefix("arm.s.").partition("[")[0]
        assert key in content or key in ("n_joints", "b", "a", "bend_limit")
    else:
        assert found.n_sections == 1


@pytest.mark.parametrize("key", ["twist_mm", "twist_rad", "n_joints_g", "half_spacing_deg", "mass_kg", "_deg", "deg"])
def test_a_unit_that_is_none_of_the_quantity_is_refused(key: str) -> None:
    with pytest.raises(InvalidValueError, match=rf"^arm\.s\.{key} is 1"):
        arm_of(**SECTION, **{key: 1.0})


def test_a_slip_in_a_key_with_a_unit_suggests_the_right_one() -> None:
    with pytest.raises(InvalidValueError, match=r"did you mean cable_azimuths_deg"):
        arm_of(**SECTION, cable_azimuth_deg=[0.0, 90.0, 180.0])


@pytest.mark.parametrize("n", [1, 4])
def test_a_model_file_takes_the_names_of_arm_files_and_other_units(tmp_path: Path, n: int) -> None:
    model = random_model(71, n)
    save_model(model, tmp_path / "model.yaml")
    content = yaml.safe_load((tmp_path / "model.yaml").read_text(encoding="utf-8"))
    short = {long: name for name, long in PAIRS.items()}
    renamed = {}
    for name, entry in content["parameters"].items():
        unit = {"m": "mm", "kg": "g", "rad": "deg"}.get(entry["unit"])
        if unit:
            entry |= {"unit": unit, "value": scaled(entry["value"], IN_UNIT[unit])}
        renamed[short.get(name, name)] = entry
    assert set(PAIRS) <= renamed.keys()
    (tmp_path / "renamed.yaml").write_text(yaml.safe_dump(content | {"parameters": renamed}), encoding="utf-8")
    found = load_model(tmp_path / "renamed.yaml").values()
    assert found.keys() == model.values().keys()
    for name, value in model.values().items():
        np.testing.assert_allclose(found[name], value, rtol=1e-14, err_msg=name)


def test_a_model_file_with_both_names_is_refused_by_both() -> None:
    entries = {name: {"value": 0.02, "unit": "m"} for name in ("b", "half_spacing")}
    with pytest.raises(InvalidValueError, match=r"^parameters\.half_spacing is .*parameters\.b "):
        model_from_mapping({"n_joints": 2, "parameters": entries})


def test_an_error_of_a_model_file_has_its_key() -> None:
    with pytest.raises(InvalidValueError, match=r"^parameters\.link_mass\.unit is 'm'; allowed: 'kg' or 'g'"):
        model_from_mapping({"n_joints": 2, "parameters": {"link_mass": {"value": 1.0, "unit": "m"}}})
