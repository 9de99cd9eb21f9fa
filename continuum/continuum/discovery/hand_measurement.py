"""Values of effects that were measured by hand: facts that every model of a diagnosis includes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.parameters import RATIO, ByHand, Parameter
from continuum.errors import InvalidValueError
from continuum.estimation.structure import absent_values
from continuum.significant_digits import rounded

_FORM: Final = "NAME[JOINT]=VALUE UNIT, optionally +-SD, as tip_payload.mass=50g, rest_angle.angle[3]=4+-0.5deg"
_NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_MEASURED: Final = re.compile(
    rf"(\w+)\.(\w+)(?:\[(\d+)\])?\s*=\s*({_NUMBER})\s*(?:(?:\+-|\+/-|±)\s*({_NUMBER}))?\s*([a-zA-Z%/]*)\s*"
)
_UNITS: Final = {
    "rad": {"rad": 1.0, "deg": np.pi / 180}, "kg": {"kg": 1.0, "g": 1e-3}, "s": {"s": 1.0, "ms": 1e-3},
    "1": {"": 1.0, "%": 0.01}, "%": {"%": 0.01},
}  # fmt: skip
"""Units in which a value may be given, by its SI unit; a ratio minus one is given in percent."""


@dataclass(frozen=True)
class HandMeasurement:
    """A measured value of the arm.

    Attributes:
        effect, parameter: what was measured.
        joint: where, from 0; None if it belongs to none.
        value, sd: value and standard deviation [unit of the parameter].

    Raises:
        InvalidValueError: no such effect, parameter or joint; one that cannot be measured by hand; a value out of
            bounds; a standard deviation that is not above 0.
    """

    effect: str
    parameter: str
    joint: int | None
    value: float
    sd: float

    def __post_init__(self) -> None:
        spec, _ = _measurable(self.effect, self.parameter)
        if spec.per_joint == (self.joint is None):
            allowed = f"with {'a joint, as ' + self.name + '[1]' if spec.per_joint else 'no joint'}"
            raise InvalidValueError("measured value", self.name, allowed)
        if not spec.lower - self.sd <= self.value <= spec.upper:
            raise InvalidValueError(self.name, self.value, f"{spec.lower:g} to {spec.upper:g} {spec.unit}")
        if not 0 < self.sd < np.inf:
            raise InvalidValueError(f"standard deviation of {self.name}", self.sd, "a finite number > 0")

    @property
    def name(self) -> str:
        """Name as in tables, joints from 1."""
        return f"{self.effect}.{self.parameter}" + (f"[{self.joint + 1}]" if self.joint is not None else "")

    @property
    def key(self) -> tuple[str, str, int]:
        """Effect, parameter and joint, -1 if it belongs to none."""
        return self.effect, self.parameter, -1 if self.joint is None else self.joint

    @property
    def is_none(self) -> bool:
        """Whether the value is no more than the instrument's error."""
        return abs(self.value) <= 2 * self.sd

    def __str__(self) -> str:
        unit = effect_named(self.effect).parameters[self.parameter].unit
        return f"{self.name} = {rounded(self.value, 4)} +- {rounded(self.sd, 2)}" + f" {unit}" * (unit != "1")


def measurement_of(text: str) -> HandMeasurement:
    """Parse a measurement; if it has no standard deviation, it gets that of the usual instrument.

    Raises:
        InvalidValueError: another form, no unit or an unknown one, or as for `HandMeasurement`.
    """
    found = _MEASURED.fullmatch(text)
    if found is None:
        raise InvalidValueError("measured value", text, _FORM)
    effect, parameter, joint, value, sd, unit = found.groups()
    spec, by_hand = _measurable(effect, parameter)
    units = _UNITS["%"] if spec.meaning.endswith(RATIO) else _UNITS.get(spec.unit, {spec.unit: 1.0})
    if unit not in units and float(value) != 0:
        raise InvalidValueError(f"unit of {effect}.{parameter}", unit, " or ".join(one or "none" for one in units))
    factor = units.get(unit, 1.0)
    deviation = factor * float(sd) if sd else by_hand.sd
    return HandMeasurement(effect, parameter, int(joint) - 1 if joint else None, factor * float(value), deviation)


def _measurable(effect: str, parameter: str) -> tuple[Parameter, ByHand]:
    """Return a parameter that all recordings share and that can be measured by hand."""
    known = effect_named(effect).parameters
    if parameter not in known:
        raise InvalidValueError(f"parameter of {effect}", parameter, f"one of {', '.join(known)}")
    spec = known[parameter]
    if spec.by_hand is None:
        able = [name for name, one in known.items() if one.by_hand and not one.per_recording]
        raise InvalidValueError(
            "measured value", f"{effect}.{parameter}",
            f"of {effect}, {', '.join(able)}" if able else "one of another effect: this is relative to fitted values",
        )  # fmt: skip
    if spec.per_recording:
        allowed = "one that all recordings share; set the sensors' zeros and name the recording with --zeroed"
        raise InvalidValueError("measured value", f"{effect}.{parameter}", allowed)
    return spec, spec.by_hand


def check_measured(measured: Sequence[HandMeasurement], model: Model) -> None:
    """Check that measurements fit this arm.

    Raises:
        InvalidValueError: a joint beyond the last, a value given twice, or an effect that the model already has or
            cannot have.
    """
    present = {active.effect.name for active in model.effects}
    for number, one in enumerate(measured):
        if one.joint is not None and not 0 <= one.joint < model.n_joints:
            raise InvalidValueError("joint of a measured value", one.joint + 1, f"1 to {model.n_joints}")
        if one.effect in present:
            raise InvalidValueError("measured effect", one.effect, "one that is not in the model: change it there")
        if not effect_named(one.effect).acts_on(model.parameters):
            raise InvalidValueError("measured effect", one.effect, "one that can act on this arm")
        if one.key in {other.key for other in measured[:number]}:
            raise InvalidValueError("measured value", one.name, "each value only once")


def with_measured(model: Model, measured: Sequence[HandMeasurement]) -> Model:
    """Return the model with the measured values; one within its instrument's error counts as absent."""
    values = dict[str, dict[str, Array]]()
    for one in measured:
        if not one.is_none:
            absent = {name: np.array(v) for name, v in absent_values(effect_named(one.effect), model.n_joints).items()}
            values.setdefault(one.effect, absent)[one.parameter][max(one.key[2], 0)] = one.value
    added = tuple(ActiveEffect(effect_named(name), found) for name, found in values.items())
    return replace(model, effects=(*model.effects, *added))


def known_whole(effect: Effect, measured: Iterable[HandMeasurement], n_joints: int) -> bool:
    """Whether measurements leave nothing of an effect to search for.

    An effect with states, or one that delays, is entirely known if its size is.
    """
    those = [one for one in measured if one.effect == effect.name]
    has_shape = bool(effect.n_states(n_joints)) or any(one.parameter == "delay" for one in those)
    return has_shape and any(one.joint is None or not one.is_none for one in those)
