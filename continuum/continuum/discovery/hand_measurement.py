"""Values of effects that somebody measured by hand."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from continuum.dynamics.effect import Effect
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.parameters import Parameter
from continuum.errors import InvalidValueError

_FORM = (
    "EFFECT.PARAMETER[JOINT]@RECORDING=VALUE+-SD, as tip_payload.mass=0.05+-0.002, rest_angle.angle[3]=0 or "
    "angle_offset.offset[3]@run_4=0"
)
_MEASURED = re.compile(r"(\w+)\.(\w+)(?:\[(\d+)\])?(?:@([^=]+))?\s*=\s*([^\s±]+?)\s*(?:(?:\+-|\+/-|±)\s*(\S+))?\s*")


@dataclass(frozen=True)
class HandMeasurement:
    """A value of the arm, or of a sensor in one recording.

    Attributes:
        effect, parameter: what was measured.
        joint: where, from 0; None where it belongs to none.
        value, sd: with its standard deviation [unit of the parameter].
        recording: in which, by name, of what differs from recording to recording; None of what does not.

    Raises:
        InvalidValueError: no such effect, parameter or joint; a recording too many or too few; a value out of bounds; a
            standard deviation that is not above 0.
    """

    effect: str
    parameter: str
    joint: int | None
    value: float
    sd: float
    recording: str | None = None

    def __post_init__(self) -> None:
        known = effect_named(self.effect).parameters
        if self.parameter not in known:
            raise InvalidValueError(f"parameter of {self.effect}", self.parameter, f"one of {', '.join(known)}")
        spec = known[self.parameter]
        if spec.per_recording == (self.recording is None):
            raise InvalidValueError(
                "measured value", self.name, f"with {'a' if spec.per_recording else 'no'} recording"
            )
        if spec.per_joint == (self.joint is None):
            raise InvalidValueError("measured value", self.name, f"with {'a' if spec.per_joint else 'no'} joint")
        if not spec.lower <= self.value <= spec.upper:
            raise InvalidValueError(self.name, self.value, f"{spec.lower:g} to {spec.upper:g} {spec.unit}")
        if not 0 < self.sd < np.inf:
            raise InvalidValueError(f"standard deviation of {self.name}", self.sd, "a finite number > 0")

    @property
    def name(self) -> str:
        """As tables have it, joints from 1."""
        where = f"[{self.joint + 1}]" if self.joint is not None else ""
        return f"{self.effect}.{self.parameter}{where}" + (f"@{self.recording}" if self.recording is not None else "")

    @property
    def key(self) -> tuple[str, str, int]:
        """Effect, parameter and joint, -1 where it belongs to none."""
        return self.effect, self.parameter, -1 if self.joint is None else self.joint

    def __str__(self) -> str:
        return f"{self.name}={self.value:g}+-{self.sd:g}"


def measurement_of(text: str) -> HandMeasurement:
    """A measurement as a person writes it; without a standard deviation that of the usual instrument.

    Raises:
        InvalidValueError: another form, or as of `HandMeasurement`.
    """
    found = _MEASURED.fullmatch(text)
    if found is None:
        raise InvalidValueError("measured value", text, _FORM)
    effect, parameter, joint, recording, value, sd = found.groups()
    spec = effect_named(effect).parameters.get(parameter)
    try:
        deviation = float(sd) if sd else (spec.by_hand if spec is not None else 1.0)
        at = int(joint) - 1 if joint else None
        return HandMeasurement(effect, parameter, at, float(value), deviation, recording)
    except ValueError as error:
        if isinstance(error, InvalidValueError):
            raise
        raise InvalidValueError("measured value", text, _FORM) from error


def zeros_set(recording: str, n_joints: int) -> list[HandMeasurement]:
    """Of a recording before which the sensors' zeros were set by a protractor."""
    return [
        HandMeasurement(effect, name, joint, 0.0, spec.by_hand, recording)
        for effect in effect_names()
        for name, spec in effect_named(effect).parameters.items()
        if is_zero(spec)
        for joint in range(n_joints)
    ]


def is_zero(spec: Parameter) -> bool:
    """Whether a parameter is a sensor's zero, which a protractor shows."""
    return spec.per_recording and spec.per_joint and spec.by_hand > 0


def check_measured(
    measured: Sequence[HandMeasurement], offered: Iterable[Effect], n_joints: int, recordings: Sequence[str]
) -> None:
    """Refuse what this arm does not have.

    Raises:
        InvalidValueError: a joint beyond the last, an unknown recording, a value twice, or an effect that is not tried
            on this arm.
    """
    names = {effect.name for effect in offered}
    for number, one in enumerate(measured):
        if one.joint is not None and not 0 <= one.joint < n_joints:
            raise InvalidValueError("joint of a measured value", one.joint + 1, f"1 to {n_joints}")
        if one.effect not in names:
            allowed = f"an effect that is tried on this arm and not in its model: {', '.join(sorted(names))}"
            raise InvalidValueError("measured effect", one.effect, allowed)
        if one.recording is not None and one.recording not in recordings:
            raise InvalidValueError("recording of a measured value", one.recording, f"one of {', '.join(recordings)}")
        if one.name in {other.name for other in measured[:number]}:
            raise InvalidValueError("measured value", one.name, "each once")
