"""A dynamic model: the parameters of Eq. 12, what drives the arm, and the effects that extend the equation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property

from continuum.dynamics.effect import Effect
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import PARAMETERS, Parameter, Parameters
from continuum.dynamics.planar.cable_tension import SIDES
from continuum.errors import InvalidValueError

DRY_SLOPE, CABLE_SLOPE = 1000.0, 2e4
"""Slopes k_v [s/rad] and k_l [s/m] at which smoothed friction can no longer be told from Coulomb's."""


class InputKind(Enum):
    """What drives an arm: its cables, or torques at its joints. By the names that model files use."""

    CABLES = "cables"
    JOINT_TORQUES = "joint_torques"

    @property
    def in_words(self) -> str:
        """As messages name it."""
        return {"cables": "tensions of cables", "joint_torques": "joint torques"}[self.value]


@dataclass(frozen=True)
class ActiveEffect:
    """An effect in a model, with the values of its parameters, (n_joints,) or (1,) each."""

    effect: Effect
    values: Mapping[str, Numbers]


@dataclass(frozen=True)
class Model:
    """One planar arm.

    Attributes:
        parameters: of Eq. 12.
        effects: beyond Eq. 12, in the order in which they are applied.
        sources: where each parameter's value comes from, by its name.
        inputs: what drives the arm. Where torques do, cables that it may have are let go.

    Raises:
        InvalidValueError: cables are to drive an arm that has none, or an effect acts on cables where torques drive it.
    """

    parameters: Parameters
    effects: tuple[ActiveEffect, ...] = ()
    sources: Mapping[str, str] = field(default_factory=dict)
    inputs: InputKind = InputKind.CABLES

    def __post_init__(self) -> None:
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
        """Refuse a model that no cables drive.

        Args:
            user: what needs them, as the message names it.

        Raises:
            InvalidValueError: joint torques drive it.
        """
        if self.inputs is not InputKind.CABLES:
            raise InvalidValueError("what drives the model", self.inputs.value, f"cables, which {user} needs")

    @property
    def n_joints(self) -> int:
        """Number of joints."""
        return self.parameters.n_joints

    @property
    def n_inputs(self) -> int:
        """Number of inputs: of cables, or of joints."""
        return len(SIDES) if self.inputs is InputKind.CABLES else self.n_joints

    @cached_property
    def changed_parameters(self) -> Parameters:
        """Parameters of Eq. 12 as the effects make them."""
        p = self.parameters
        for active in self.effects:
            p = active.effect.change_parameters(p, active.values)
        return p

    @property
    def n_states(self) -> int:
        """States of the effects, beside the joints' angles and rates."""
        return sum(active.effect.n_states(self.n_joints) for active in self.effects)

    def values(self) -> dict[str, Numbers]:
        """All parameter values, (n_joints,) or (1,) each, by name; those of an effect as ``effect.parameter``."""
        found = dict(self.parameters.named())
        for active in self.effects:
            found |= {f"{active.effect.name}.{name}": value for name, value in active.values.items()}
        return found

    def meanings(self) -> dict[str, Parameter]:
        """What each of `values` means and may be, by the same names."""
        found = {name: PARAMETERS[name] for name in self.parameters.named()}
        for active in self.effects:
            found |= {f"{active.effect.name}.{name}": spec for name, spec in active.effect.parameters.items()}
        return found

    def with_values(self, changed: Mapping[str, object]) -> Model:
        """The model with some values changed, checked against their bounds.

        A parameter that may be absent, as ``link_length``, can be given to a model that has none.

        Raises:
            InvalidValueError: an unknown name, or a value that its parameter may not have.
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
        """The same model around other arrays, floats or symbols, named as in `values`; unchecked."""
        return replace(
            self,
            parameters=Parameters(**{name: values[name] for name in PARAMETERS if name in values}),
            effects=tuple(
                replace(active, values={name: values[f"{active.effect.name}.{name}"] for name in active.values})
                for active in self.effects
            ),
        )


def with_dry_friction(model: Model) -> Model:
    """The model with k_v and k_l of its friction at least that large; a smoother sign creeps where an arm rests."""
    steep = {"friction_slope": DRY_SLOPE, "cable_slope": CABLE_SLOPE}
    raised = {name: sensitivity for name, sensitivity in steep.items() if sensitivity > float(model.values()[name][0])}
    sources = dict(model.sources) | dict.fromkeys(raised, "so steep that it cannot be told from dry friction")
    return replace(model.with_values(raised), sources=sources)
