"""All installed effects on the prototype, their values at any size, and their compiled equations."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from dynamics_laws import active, moving, prototype_model, random_parameters

from continuum.dynamics.effect import Effect
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.integration.esdirk_tableau import fourth_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions

N = 5
EFFECTS = effect_names()
RELEASED = np.radians([18.0, 15.0, 17.0, 12.0, 14.0])
LOOSE = np.zeros(2)
"""Tensions of cables that do not pull."""

PULLS = Tensions([0.0, 0.14, 0.16, 0.24, 0.31], [[0.0, 0.0], [0.0, 0.0], [9.0, 1.0], [2.0, 8.0], [2.0, 8.0]])
"""Nothing for half of a short run, then one cable and the other."""

EXACT = Tolerances(1e-8, 1e-9, 0.01)
SUDDEN = {"slack_cable": Tolerances(3e-11, 3e-12, 0.0001)}
"""Where motors switch within a millisecond: differences of less exact runs are rougher than their derivatives."""


@lru_cache
def effect_of(name: str) -> Effect:
    """The effect; it has no state of its own, and looking it up takes its time."""
    return effect_named(name)


STATEFUL = [name for name in EFFECTS if effect_of(name).n_states(N)]


def is_size(parameter: Parameter) -> bool:
    """Whether it says how large an effect is; the others say what it looks like."""
    return parameter.default == 0


def sized(name: str, times_typical: float) -> dict[str, float]:
    """Parameters of the effect at a multiple of their typical size, within bounds; what is no size, at its default."""
    found = {}
    for key, parameter in effect_of(name).parameters.items():
        grown = parameter.default + times_typical * parameter.typical * is_size(parameter)
        found[key] = float(np.clip(grown, parameter.lower, parameter.upper))
    return found


def drawn(name: str, random: np.random.Generator) -> dict[str, np.ndarray]:
    """Arrays of the effect's parameters, each joint with its own: up to twice the typical size, of either sign."""
    found = {}
    for key, parameter in effect_of(name).parameters.items():
        step = parameter.typical * random.uniform(0.3, 2.0, N if parameter.per_joint else 1)
        sign = random.choice([-1.0, 1.0], step.size)
        found[key] = np.clip(parameter.default + sign * step, parameter.lower, parameter.upper)
        if is_size(parameter) and parameter.lower == 0:
            found[key] = step
    return found


def extended(model: Model, name: str, values: dict[str, float] | None = None) -> Model:
    """The model with the effect, at its defaults where no values are given."""
    return Model(model.parameters, (active(effect_of(name), model.n_joints, **(values or {})),))


def prototype_with(name: str, times_typical: float) -> Model:
    return extended(prototype_model(N), name, sized(name, times_typical))


def random_with(name: str, seed: int) -> Model:
    """Every parameter random, every joint with its own."""
    random = np.random.default_rng(seed)
    model = extended(Model(random_parameters(random, N)), name)
    return model.with_values({f"{name}.{key}": value for key, value in drawn(name, random).items()})


@lru_cache
def simulator(name: str, tolerances: Tolerances = EXACT) -> Simulator:
    """Of any model with this effect, by `around`; exact enough for differences of its runs."""
    return Simulator(prototype_with(name, 0.0), tolerances, fourth_order())


def resting_state(model: Model, theta: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Whole state of an arm that is let go."""
    states = [a.effect.initial_state(theta, u, a.values, model.parameters) for a in model.effects]
    return np.concatenate([theta, np.zeros(theta.size), *states])


def torque_of(name: str, now: Instant, state: np.ndarray | None = None, **values: float) -> np.ndarray:
    """Torque that the effect adds, (n,)."""
    one = active(effect_of(name), now.p.n_joints, **values)
    state = np.zeros(0) if state is None else state
    return one.effect.torque(now, one.values, state) * np.ones(now.p.n_joints)


def instants(seed: int, count: int = 30, u: np.ndarray = LOOSE) -> list[Instant]:
    """Random ones, slow and fast, of arms that all differ."""
    random = np.random.default_rng(seed)
    return [
        Instant(
            moving(random.uniform(-0.6, 0.6, N), random.normal(0, 10 ** random.uniform(-3, 1), N)),
            u,
            random_parameters(random, N),
        )
        for _ in range(count)
    ]
