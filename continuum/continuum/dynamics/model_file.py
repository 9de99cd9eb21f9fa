"""Model files: YAML with every parameter's value, unit and source, and the effects that extend Eq. 12.

::

    n_joints: 5
    inputs: cables
    joints: [hinge_1, hinge_2, hinge_3, hinge_4, hinge_5]
    parameters:
      stiffness: {value: 1.2379, unit: N m/rad, source: thesis Table 3}
    effects:
      tip_payload:
        mass: {value: 0.05, unit: kg, source: diagnosis of run_3.csv}

``inputs`` are ``cables`` or ``joint_torques``; without the line they are cables, unless the arm is told to have none: a
chain with neither ``half_spacing`` nor ``hole_radius`` is driven by torques. ``b``, ``a``, ``link_mass`` and
``link_inertia``, the names of arm files, are taken too. Angles may be given in deg, lengths in mm and masses in g.

``joints``, which may be left out, are the names that messages have for the joints, from base to tip. Where the angle of
a message is not the model's, an entry gives both: ``{name: elbow, sign: -1, zero: {value: 90, unit: deg}}``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import cast

import yaml

from continuum.arm import arm_block
from continuum.did_you_mean import did_you_mean
from continuum.dynamics.effect import Effect
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.model import ActiveEffect, InputKind, Model, NamedJoint
from continuum.dynamics.parameters import PARAMETERS, Parameter, Parameters
from continuum.dynamics.section_model import SectionModel, is_arm_file, section_model
from continuum.errors import InvalidValueError
from continuum.parameter_file import read_parameter_file
from continuum.parameter_keys import convertible, given_values, in_si, units_for
from continuum.shipped_files import MODELS, find_file
from continuum.whole_file import write_whole

_UNITS = {name: parameter.unit for name, parameter in PARAMETERS.items()}
_ENTRY = "a mapping of value, unit and source"
_PARAMETERS, _EFFECTS = "a block of parameters by name", "a block of effects by name"


def load_model(path: str | Path, section: str | None = None) -> Model:
    """The model that a file describes; a bare name that is no file here is a model that comes with the library.

    Args:
        path: a model file, or an arm file with a block ``dynamics``.
        section: of an arm file, the section that is meant; None where it has only one. A model file has none.

    Raises:
        FileError: the file cannot be read, is no YAML mapping, or describes an arm's geometry alone.
        InvalidValueError: a name, value or unit that is not allowed, or a required parameter that is missing; the
            message begins with the file's name.
    """
    return load_named_model(path, section)[0]


def load_named_model(path: str | Path, section: str | None = None) -> tuple[Model, str | None]:
    """As :func:`load_model`, with the name of the section of an arm file; None of a model file."""
    content = read_parameter_file(find_file(path, MODELS))
    try:
        if not is_arm_file(content):
            return model_from_mapping(content), None
        found = section_model(path, content, section)
        return _model_of(found), found.section
    except InvalidValueError as error:
        raise InvalidValueError(f"{path}: {error.name}", error.value, error.allowed) from None


def model_of_section(path: str | Path, content: Mapping[str, object], section: str | None) -> Model:
    """As :func:`load_model`, of an arm file's contents; ``path`` names the file in errors.

    Raises:
        FileError: no section has a block ``dynamics``.
        InvalidValueError: a value that is not allowed, or one that is required and missing.
    """
    return _model_of(section_model(path, content, section))


def sections_in(path: str | Path) -> tuple[str, ...]:
    """Names of the sections in an arm file; none of a model file.

    Raises:
        FileError: the file cannot be read.
    """
    content = read_parameter_file(find_file(path, MODELS))
    if not is_arm_file(content):
        return ()
    names = arm_block(path, content)["sections"]
    return tuple(map(str, names)) if isinstance(names, list) else ()


def section_inputs(path: str | Path, sections: Sequence[str]) -> dict[str, InputKind]:
    """Inputs of sections of an arm file, by name; a section alone moves in the plane of its cables, several in space.

    Raises:
        FileError, InvalidValueError: as :func:`load_model`.
    """
    if len(sections) == 1:
        return {sections[0]: load_model(path, sections[0]).inputs}
    models = section_models(path, read_parameter_file(find_file(path, MODELS)), sections)
    return {name: model.inputs for name, model in zip(sections, models, strict=True)}


def section_models(path: str | Path, content: Mapping[str, object], sections: Iterable[str]) -> list[Model]:
    """The models of the sections of an arm in space, from an arm file's contents; as :func:`model_of_section`."""
    return [_model_of(section_model(path, content, name, planar=False)) for name in sections]


def _model_of(found: SectionModel) -> Model:
    try:
        return model_from_mapping(found.mapping)
    except InvalidValueError as error:
        raise found.in_arm_file(error) from None


def model_from_mapping(block: Mapping[str, object]) -> Model:
    """As :func:`load_model`, of a file's contents.

    Raises:
        InvalidValueError: a name, value or unit that is not allowed, or a required parameter that is missing.
    """
    _only(block, ("n_joints", "inputs", "joints", "parameters", "effects"), "")
    n = block.get("n_joints")
    if not isinstance(n, int) or isinstance(n, bool) or not 1 <= n <= 1000:
        raise InvalidValueError("n_joints", n, "a whole number from 1 to 1000")
    own = given_values(_mapping(block, "parameters"), _UNITS, "parameters.", with_units=False)
    try:
        values, sources = _values(own.values, PARAMETERS, n, "parameters.")
    except InvalidValueError as error:
        raise own.as_written(error, "parameters.") from None
    effects = []
    named = _mapping(block, "effects", allowed=_EFFECTS)
    for name in named:
        effect: Effect = effect_named(name)
        given = _mapping(named, name, "effects.")
        params, given_sources = _values(given, effect.parameters, n, f"effects.{name}.")
        effects.append(ActiveEffect(effect, params))
        sources |= {f"{name}.{key}": source for key, source in given_sources.items()}
    inputs = _inputs(block.get("inputs"), values)
    try:
        return Model(Parameters(**values), tuple(effects), sources, inputs, _joints(block.get("joints")))
    except InvalidValueError as error:
        where = "parameters." if error.name in PARAMETERS else ""
        raise InvalidValueError(f"{where}{error.name}", error.value, error.allowed) from None


def save_model(model: Model, path: str | Path) -> None:
    """Write a model so that :func:`load_model` gives it back.

    Raises:
        FileError: the file cannot be written.
    """
    parameters: dict[str, object] = {}
    effects: dict[str, dict[str, object]] = {active.effect.name: {} for active in model.effects}
    meanings = model.meanings()
    for name, value in model.values().items():
        number = float(value[0]) if (value == value[0]).all() else [float(item) for item in value]
        entry = {"value": number, "unit": meanings[name].unit, "source": model.sources.get(name, "not stated")}
        owner, _, key = name.rpartition(".")
        (effects[owner] if owner else parameters)[key] = entry
    written: dict[str, object] = {"n_joints": model.n_joints, "inputs": model.inputs.value}
    if model.joints:
        written["joints"] = joints_block(model.joints)
    written |= {"parameters": parameters, "effects": effects}
    write_whole(path, yaml.safe_dump(written, sort_keys=False))


def joints_block(joints: Iterable[NamedJoint]) -> list[object]:
    """The value of ``joints`` in a model file: a name, or more where the angle of a message is not the model's."""
    return [
        one.name
        if (one.sign, one.zero) == (1, 0)
        else {"name": one.name, "sign": int(one.sign), "zero": {"value": float(one.zero), "unit": "rad"}}
        for one in joints
    ]


def _joints(given: object) -> tuple[NamedJoint, ...]:
    if given is None:
        return ()
    if not isinstance(given, list):
        raise InvalidValueError("joints", given, "a list of names, from base to tip")
    return tuple(_joint(f"joints[{number}]", one) for number, one in enumerate(given, 1))


def _joint(where: str, given: object) -> NamedJoint:
    if not isinstance(given, Mapping):
        return NamedJoint(cast("str", given))
    _only(given, ("name", "sign", "zero"), f"{where}.")
    zero = _mapping(given, "zero", f"{where}.", "a mapping of value and unit")
    _only(zero, ("value", "unit"), f"{where}.zero.")
    value, unit = zero.get("value", 0.0), zero.get("unit", "rad")
    if convertible(unit, "rad"):
        value = in_si(value, str(unit))
    elif unit != "rad":
        raise InvalidValueError(f"{where}.zero.unit", unit, " or ".join(map(repr, units_for("rad"))))
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InvalidValueError(f"{where}.zero.value", value, "a number")
    return NamedJoint(cast("str", given.get("name")), cast("float", given.get("sign", 1)), float(value))


def _inputs(given: object, values: Mapping[str, Numbers]) -> InputKind:
    """What drives the arm; what the arm is told to have where the file does not say."""
    if given is None:
        return InputKind.CABLES if {"half_spacing", "hole_radius"} & values.keys() else InputKind.JOINT_TORQUES
    for kind in InputKind:
        if given == kind.value:
            return kind
    raise InvalidValueError("inputs", given, " or ".join(kind.value for kind in InputKind))


def _values(
    block: Mapping[str, object], allowed: Mapping[str, Parameter], n: int, prefix: str
) -> tuple[dict[str, Numbers], dict[str, str]]:
    """Arrays and sources of a block of parameters."""
    _only(block, allowed, prefix)
    values, sources = {}, {}
    for name, parameter in allowed.items():
        if name not in block:
            if parameter.optional:
                continue
            if parameter.default is None:
                raise InvalidValueError(prefix + name, None, parameter.allowed)
            values[name] = parameter.array(parameter.default, n, prefix + name)
            continue
        entry = _mapping(block, name, prefix, _ENTRY)
        _only(entry, ("value", "unit", "source"), f"{prefix}{name}.")
        value, unit = entry.get("value"), entry.get("unit")
        if convertible(unit, parameter.unit):
            value = in_si(value, str(unit))
        elif unit != parameter.unit:
            raise InvalidValueError(f"{prefix}{name}.unit", unit, " or ".join(map(repr, units_for(parameter.unit))))
        values[name] = parameter.array(value, n, prefix + name)
        sources[name] = str(entry.get("source", "not stated"))
    return values, sources


def _mapping(
    block: Mapping[str, object], name: str, prefix: str = "", allowed: str = _PARAMETERS
) -> Mapping[str, object]:
    found = block.get(name)
    if found is None:
        return {}
    if not isinstance(found, Mapping):
        raise InvalidValueError(prefix + name, found, allowed)
    return found


def _only(block: Mapping[str, object], allowed: Iterable[str], prefix: str) -> None:
    names = tuple(allowed)
    for key in block:
        if key not in names:
            near = did_you_mean(str(key), names)
            raise InvalidValueError(f"{prefix}{key}", block[key], f"not known here; one of {', '.join(names)}{near}")
