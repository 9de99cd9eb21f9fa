"""A dynamic model: the parameters of Eq. 12, and the effects that extend it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from continuum.dynamics.effect import Effect
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import PARAMETERS, Parameter, Parameters
from continuum.errors import InvalidValueError


@dataclass(frozen=True)
class ActiveEffect:
    """An effect in a model, with the values of its parameters, (n_joints,) or (1,) each."""

    effect: Effect
    values: Mapping[str, Numbers]


@dataclass(frozen=True)
class Model:
    """One planar section.

    Attributes:
        parameters: of Eq. 12.
        effects: beyond Eq. 12, in the order in which they are applied.
        sources: where each parameter's value comes from, by its name.
    """

    parameters: Parameters
    effects: tuple[ActiveEffect, ...] = ()
    sources: Mapping[str, str] = field(default_factory=dict)

    @property
    def n_joints(self) -> int:
        """Number of joints."""
        return self.parameters.n_joints

    @property
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
