"""Model files: what is written is read back; a bad file is one clear error of the library, nothing else."""

import copy
import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
import yaml
from dynamics_laws import PROTOTYPE, LaggingDrive, TipLoad, Wind, active, random_model
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum import dynamics
from continuum.dynamics.effect import Effect
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model, model_from_mapping, save_model
from continuum.dynamics.parameters import PARAMETERS
from continuum.errors import ContinuumError, FileError, InvalidValueError

UNITS = {name: parameter.unit for name, parameter in PARAMETERS.items()}
REQUIRED = ["mass", "inertia", "center_of_mass", "half_spacing", "hole_radius"]


def content(n_joints: int = 3) -> dict[str, object]:
    """A right file."""
    values = random_model(51, n_joints).values()
    return {
        "n_joints": n_joints,
        "parameters": {
            name: {"value": values[name].tolist(), "unit": UNITS[name], "source": f"measured {name}"}
            for name in REQUIRED
        },
        "effects": {},
    }


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A package that offers this test's effects."""
    info = tmp_path / "site" / "some_effects-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: some-effects\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text(
        textwrap.dedent("""\
            [continuum.effects]
            tip_load = dynamics_laws:TipLoad
            wind = dynamics_laws:Wind
            lagging_drive = dynamics_laws:LaggingDrive
            bare = effects_without_parameters:Bare
            """),
        encoding="utf-8",
    )
    (tmp_path / "site" / "effects_without_parameters.py").write_text(
        "from continuum.dynamics.effect import Effect\n\n\nclass Bare(Effect):\n    name = 'bare'\n", encoding="utf-8"
    )
    monkeypatch.syspath_prepend(tmp_path / "site")


def assert_same(found: Model, expected: Model) -> None:
    assert list(found.values()) == list(expected.values())
    for name, value in expected.values().items():
        np.testing.assert_array_equal(found.values()[name], value)
    assert [part.effect.name for part in found.effects] == [part.effect.name for part in expected.effects]


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize("n", [1, 2, 5])
def test_a_written_model_is_read_back(tmp_path: Path, n: int) -> None:
    effects = (active(Wind(), n, torque=0.1), active(TipLoad(), mass=0.2), active(LaggingDrive(), lag=1e-5))
    model = Model(
        random_model(52, n).parameters, effects, {"mass": "a: scale # 1", "wind.torque": "guess\nof two lines"}
    )
    save_model(model, tmp_path / "model.yaml")
    found = load_model(tmp_path / "model.yaml")
    assert_same(found, model)
    for name, source in model.sources.items():
        assert found.sources[name] == source
    save_model(found, str(tmp_path / "again.yaml"))
    assert (tmp_path / "again.yaml").read_text() == (tmp_path / "model.yaml").read_text()


@pytest.mark.usefixtures("installed")
def test_an_effect_without_parameters_is_read_back(tmp_path: Path) -> None:
    model = Model(random_model(53, 2).parameters, (active(effect_named("bare")),))
    save_model(model, tmp_path / "model.yaml")
    assert_same(load_model(tmp_path / "model.yaml"), model)


@pytest.mark.usefixtures("installed")
def test_effects_are_found_by_their_entry_points() -> None:
    assert {"tip_load", "wind", "lagging_drive", "bare"} <= set(effect_names())
    assert isinstance(effect_named("wind"), Wind)
    assert isinstance(effect_named("bare"), Effect)
    with pytest.raises(InvalidValueError, match="wind"):
        effect_named("winds")


def test_defaults_sources_and_one_number_for_all_joints() -> None:
    block = content()
    parameters: dict[str, dict[str, object]] = block["parameters"]  # type: ignore[assignment]
    parameters["stiffness"] = {"value": 2, "unit": "N m/rad"}
    model = model_from_mapping(block)
    np.testing.assert_array_equal(model.parameters.stiffness, [2.0, 2.0, 2.0])
    assert model.parameters.gravity == [9.81]
    assert model.sources["mass"] == "measured mass"
    assert model.n_joints == 3
    assert model_from_mapping({key: block[key] for key in ("n_joints", "parameters")}).effects == ()


def test_zeros_of_joints_may_be_in_degrees() -> None:
    block = content(2)
    block["joints"] = ["hip", {"name": "knee", "sign": -1, "zero": {"value": 90, "unit": "deg"}}]
    hip, knee = model_from_mapping(block).joints
    assert (hip.name, hip.sign, hip.zero) == ("hip", 1, 0)
    assert (knee.name, knee.sign, knee.zero) == ("knee", -1, pytest.approx(np.pi / 2))


Change = Callable[[dict], object]  # type: ignore[type-arg]
BAD: dict[str, tuple[Change, str]] = {
    "unknown block": (lambda b: b.update(parameter={}), "parameter"),
    "unknown parameter": (lambda b: b["parameters"].update(masss={"value": 1.0, "unit": "kg"}), "parameters.masss"),
    "wrong unit": (lambda b: b["parameters"]["mass"].update(unit="lb"), "parameters.mass.unit"),
    "no value": (lambda b: b["parameters"]["mass"].pop("value"), "parameters.mass"),
    "missing parameter": (lambda b: b["parameters"].pop("mass"), "parameters.mass"),
    "too few values": (lambda b: b["parameters"]["mass"].update(value=[0.1, 0.2]), "parameters.mass"),
    "nan": (lambda b: b["parameters"]["mass"].update(value=float("nan")), "parameters.mass"),
    "negative mass": (lambda b: b["parameters"]["mass"].update(value=-0.1), "parameters.mass"),
    "parameter that is a number": (lambda b: b["parameters"].update(mass=0.1), "parameters.mass"),
    "parameters that are a list": (lambda b: b.update(parameters=[1]), "parameters"),
    "no parameters": (lambda b: b.pop("parameters"), "parameters"),
    "list for the section": (
        lambda b: b["parameters"].update(gravity={"value": [9.81] * 3, "unit": "m/s2"}),
        "parameters.gravity",
    ),
    "no joints": (lambda b: b.pop("n_joints"), "n_joints"),
    "too many joints": (lambda b: b.update(n_joints=1001), "n_joints"),
    "joints without names": (lambda b: b.update(joints=3), "joints"),
    "fewer names than joints": (lambda b: b.update(joints=["hip", "knee"]), "joints"),
    "one name twice": (lambda b: b.update(joints=["hip", "knee", "hip"]), "joints"),
    "number for a name": (lambda b: b.update(joints=[1, 2, 3]), "joints"),
    "sign that is none": (lambda b: b.update(joints=["a", "b", {"name": "c", "sign": 2}]), "joints"),
    "zero in metres": (
        lambda b: b.update(joints=["a", {"name": "b", "zero": {"value": 1, "unit": "m"}}, "c"]),
        "joints[2].zero.unit",
    ),
    "zero that is text": (
        lambda b: b.update(joints=["a", {"name": "b", "zero": {"value": "x"}}, "c"]),
        "joints[2].zero.value",
    ),
    "unknown key of a joint": (lambda b: b.update(joints=["a", {"names": "b"}, "c"]), "joints[2].names"),
    "unknown effect": (lambda b: b.update(effects={"ghost": {}}), "ghost"),
    "effects that are a list": (lambda b: b.update(effects=["wind"]), "effects"),
    "unknown parameter of an effect": (
        lambda b: b.update(effects={"wind": {"speed": {"value": 1.0, "unit": "m/s"}}}),
        "effects.wind.speed",
    ),
    "wrong unit of an effect": (
        lambda b: b.update(effects={"wind": {"torque": {"value": 0.1, "unit": "N"}}}),
        "effects.wind.torque.unit",
    ),
    "value out of bounds of an effect": (
        lambda b: b.update(effects={"wind": {"torque": {"value": 2.0, "unit": "N m"}}}),
        "effects.wind.torque",
    ),
}


@pytest.mark.usefixtures("installed")
@pytest.mark.parametrize("case", BAD)
def test_a_bad_model_is_one_clear_error(case: str) -> None:
    change, output = BAD[case]
    block = copy.deepcopy(content())
    change(block)
    with pytest.raises(InvalidValueError) as caught:
        model_from_mapping(block)
    assert output in str(caught.value)
    assert "\n" not in str(caught.value)
    assert caught.value.name.startswith(output) or output == "ghost"


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"5",
        b"- 1",
        b"a: [",
        b"\xff\xfe\xfa",
        b"n_joints: 2001-99-99",
        b"&a {parameters: *a}",
        b"n_joints: 3\nparameters: &a {mass: *a}",
        b"n_joints: 3\nparameters: {mass: {value: " + b"9" * 400 + b", unit: kg}}",
    ],
)
def test_a_file_that_is_no_model(tmp_path: Path, text: bytes) -> None:
    path = tmp_path / "model.yaml"
    path.write_bytes(text)
    with pytest.raises(ContinuumError):
        load_model(path)


def test_an_error_names_its_file(tmp_path: Path) -> None:
    path = tmp_path / "model.yaml"
    path.write_text(yaml.safe_dump(content() | {"effects": {"ghost": {}}}), encoding="utf-8")
    with pytest.raises(InvalidValueError, match=f"^{path}: effect is 'ghost'; allowed: one of "):
        load_model(path)


def test_a_name_with_a_slip_is_reported_what_was_meant() -> None:
    with pytest.raises(InvalidValueError, match=r"did you mean stiffness\?"):
        model_from_mapping(content() | {"parameters": {"stifness": {"value": 1.0, "unit": "N m/rad"}}})


def test_files_that_cannot_be_read_or_written(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be read"):
        load_model(tmp_path / "none.yaml")
    with pytest.raises(FileError, match="cannot be written"):
        save_model(random_model(54, 2), tmp_path / "no" / "folder.yaml")


SCALARS = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.just(10**400)
NAMES = st.sampled_from(["n_joints", "parameters", "effects", "mass", "value", "unit", "source", "wind"]) | SCALARS
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(NAMES, inner, max_size=3),
    max_leaves=6,
)


@settings(deadline=None, max_examples=100, derandomize=True)
@given(block=st.dictionaries(NAMES, VALUES, max_size=4))
def test_anything_else_is_an_error_of_the_library(block: Mapping[str, object]) -> None:
    with pytest.raises(ContinuumError):
        model_from_mapping(block)


@settings(deadline=None, max_examples=150, derandomize=True)
@given(
    at=st.sampled_from(
        [
            ("n_joints",),
            ("parameters",),
            ("effects",),
            *(("parameters", name) for name in UNITS),
            *(("parameters", name, key) for name in REQUIRED for key in ("value", "unit", "source")),
        ]
    ),
    value=VALUES,
)
def test_one_thing_changed_is_taken_or_an_error_of_the_library(at: tuple[str, ...], value: object) -> None:
    block = copy.deepcopy(content())
    inner = block
    for key in at[:-1]:
        inner = inner[key]  # type: ignore[assignment]
    inner[at[-1]] = value
    try:
        model = model_from_mapping(block)
    except ContinuumError:
        return
    for name, array in model.values().items():
        assert np.all((array >= PARAMETERS[name].lower) & (array <= PARAMETERS[name].upper))


def test_the_prototype_is_that_of_the_theses_tables() -> None:
    """Tables 1 and 3; its last link is lighter."""
    found = load_model(Path(dynamics.__file__).parent / "models" / "lamecc_prototype.yaml")
    last = {"mass": 0.20133, "inertia": 76.822e-6}
    for name, expected in PROTOTYPE.items():
        np.testing.assert_array_equal(found.values()[name][:-1], expected, err_msg=name)
        np.testing.assert_array_equal(found.values()[name][-1], last.get(name, expected))
    assert found.n_joints == 5
    assert all(found.sources[name] for name in PROTOTYPE)
