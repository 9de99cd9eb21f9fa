"""A dynamic model: the parameters of Eq. 12, what drives the arm, and the effects that extend the equation."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property

from continuum.dynamics.effect import Effect
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import PARAMETERS, Parameter, Parameters
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.errors import InvalidValueError

DRY_SLOPE, CABLE_SLOPE = 1000.0, 2e4
"""Slopes k_v [s/rad] and k_l [s/m] at which smoothed friction is indistinguishable from Coulomb friction."""


class InputKind(Enum):
    """Inputs that drive an arm: its cables, or torques at its joints. Values are the names in model files."""

    CABLES = "cables"
    JOINT_TORQUES = "joint_torques"

    @property
    def in_words(self) -> str:
        """Name in messages."""
        return {"cables": "tensions of cables", "joint_torques": "joint torques"}[self.value]


@dataclass(frozen=True)
class ActiveEffect:
    """An effect in a model, with the values of its parameters, (n_joints,) or (1,) each."""

    effect: Effect
    values: Mapping[str, Numbers]


@dataclass(frozen=True)
class NamedJoint:
    """A joint as recordings of messages and descriptions have it: theta = sign reading + zero.

    Attributes:
        name: its name there.
        sign: 1 if the model's angle grows with the reading, otherwise -1; rates and torques change their sign too.
        zero: angle of the model at the reading 0 [rad].
    """

    name: str
    sign: float = 1.0
    zero: float = 0.0

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip():
            raise InvalidValueError("joints: name", self.name, "the name of a joint in recordings")
        if self.sign not in (1, -1):
            raise InvalidValueError(f"joints: sign of {self.name}", self.sign, "1 or -1")
        if not abs(self.zero) <= math.tau:
            raise InvalidValueError(f"joints: zero of {self.name}", self.zero, "an angle of at most a turn [rad]")

    def in_words(self, number: int) -> str:
        """Return the angle of the model's joint of a number, from 1, as a function of the reading."""
        offset = f" {'-' if self.zero < 0 else '+'} {abs(math.degrees(self.zero)):.6g} deg" if self.zero else ""
        return f"q{number} = {'-' if self.sign < 0 else ''}{self.name}{offset}"


def check_names(joints: Sequence[str], n_joints: int, name: str) -> None:
    """Check that each joint has a name of its own.

    Raises:
        InvalidValueError: their number is not ``n_joints``, or one occurs twice; ``name`` says where they stand.
    """
    if len(set(joints)) != n_joints or len(joints) != n_joints:
        raise InvalidValueError(name, ",".join(joints), f"{n_joints} different names, of the joints from base to tip")


@dataclass(frozen=True)
class Model:
    """Dynamic model of one planar arm.

    Attributes:
        parameters: parameters of Eq. 12.
        effects: effects beyond Eq. 12, in the order in which they are applied.
        sources: source of each parameter's value, by its name.
        inputs: inputs that drive the arm. If torques drive it, cables that it may have are slack.
        joints: the joints in recordings of messages, from base to tip; empty if their names are not known.

    Raises:
        InvalidValueError: an arm driven by cables has none, an effect acts on the cables of an arm that torques drive,
            or not every joint has a name of its own.
    """

    parameters: Parameters
    effects: tuple[ActiveEffect, ...] = ()
    sources: Mapping[str, str] = field(default_factory=dict)
    inputs: InputKind = InputKind.CABLES
    joints: tuple[NamedJoint, ...] = ()

    def __post_init__(self) -> None:
        if self.joints:
            check_names([one.name for one in self.joints], self.n_joints, "joints")
        if self.inputs is InputKind.CABLES:
            for name in ("half_spacing", "hole_radius"):
                if getattr(self.parameters, name) is None:
                    allowed = f"{PARAMETERS[name].allowed}; only an arm whose inputs are joint_torques has none"
                    raise InvalidValueError(name, None, allowed)
            return
        for active in self.effects:
            if active.effect.uses_cables:
                allowed = "one that does not act on cables, as the model's inputs are joint_torques"
                raise InvalidValueError("effect", active.effect.name, allowed)

    def require_cables(self, user: str) -> None:
        """Refuse a model that cables do not drive.

        Args:
            user: what needs the cables, for the message.

        Raises:
            InvalidValueError: joint torques drive the model.
        """
        if self.inputs is not InputKind.CABLES:
            raise InvalidValueError("input of the model", self.inputs.value, f"cables, which {user} needs")

    @property
    def n_joints(self) -> int:
        """Number of joints."""
        return self.parameters.n_joints

    @property
    def n_inputs(self) -> int:
        """Number of inputs: that of the cables, or that of the joints."""
        return len(SIDES) if self.inputs is InputKind.CABLES else self.n_joints

    @cached_property
    def changed_parameters(self) -> Parameters:
        """Parameters of Eq. 12 as modified by the effects."""
        p = self.parameters
        for active in self.effects:
            p = active.effect.change_parameters(p, active.values)
        return p

    @property
    def n_states(self) -> int:
        """Number of the effects' states, in addition to joint angles and rates."""
        return sum(active.effect.n_states(self.n_joints) for active in self.effects)

    def values(self) -> dict[str, Numbers]:
        """All parameter values, (n_joints,) or (1,) each, by name; those of an effect as ``effect.parameter``."""
        found = dict(self.parameters.named())
        for active in self.effects:
            found |= {f"{active.effect.name}.{name}": value for name, value in active.values.items()}
        return found

    def meanings(self) -> dict[str, Parameter]:
        """Description and bounds of each of `values`, by the same names."""
        found = {name: PARAMETERS[name] for name in self.parameters.named()}
        for active in self.effects:
            found |= {f"{active.effect.name}.{name}": spec for name, spec in active.effect.parameters.items()}
        return found

    def with_values(self, changed: Mapping[str, object]) -> Model:
        """Return the model with some values changed, checked against their bounds.

        An optional parameter such as ``link_length`` can be added to a model without it.

        Raises:
            InvalidValueError: a name is unknown, or a value is not allowed.
        """
        meanings = PARAMETERS | self.meanings()
        for name in changed:
            if name not in meanings:
                raise InvalidValueError("parameter", name, "one of " + ", ".join(meanings))
        values = self.values() | {
            name: meanings[name].array(value, self.n_joints, name) for name, value in changed.items()
        }
        return self.built_from(values)

    def built_from(self, values: Mapping[str, Numbers]) -> Model:
        """Return the model with other arrays, floats or symbols, named as in `values`; unchecked."""
        return replace(
            self,
            parameters=Parameters(**{name: values[name] for name in PARAMETERS if name in values}),
            effects=tuple(
                replace(active, values={name: values[f"{active.effect.name}.{name}"] for name in active.values})
                for active in self.effects
            ),
        )


def with_dry_friction(model: Model) -> Model:
    """Return the model with k_v and k_l steep enough for dry friction; a smoother sign lets a resting arm creep."""
    steep = {"friction_slope": DRY_SLOPE, "cable_slope": CABLE_SLOPE}
    raised = {name: slope for name, slope in steep.items() if slope > float(model.values()[name][0])}
    sources = dict(model.sources) | dict.fromkeys(raised, "steep enough to be indistinguishable from dry friction")
    return replace(model.with_values(raised), sources=sources)
