"""The diagnosed model, extended by refitted parameters and the effects of a set."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import Key
from continuum.discovery.coordinates import PARAMETER
from continuum.discovery.hypotheses import FRICTION
from continuum.discovery.problem import Problem, State, point_of
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.parameters import PARAMETERS
from continuum.dynamics.values import with_vector
from continuum.estimation.structure import absent_values

_SOURCE = "fitted to recordings by a diagnosis"


def model_of(problem: Problem, state: State, key: Key, model: Model) -> Model:
    """Return a model with the values of a state.

    Ordinary differences between parts become parameters of the model. Per-run values are left out, and so is an effect
    without any others: as a part of the model, it would not be searched for again.

    Args:
        problem, state: source of the values.
        key: effects of the set.
        model: model that was diagnosed.
    """
    s, named = problem.structure, {effect for effect, _ in key}
    base = with_vector(s.model, point_of(problem, state).values)
    if problem.coordinates.lacks_friction and FRICTION not in named:
        lacking = {PARAMETER[name] for name, _ in problem.coordinates.without_friction}
        base = base.with_values(dict.fromkeys(lacking & {"viscous_friction", "coulomb_friction"}, 0.0))
    present = {active.effect.name for active in model.effects}
    p = base.parameters
    kept: dict[str, ActiveEffect] = {}
    for active in base.effects:
        if active.effect.name in named or active.effect.name in present:
            kept[active.effect.name] = active
        else:
            p = active.effect.change_parameters(p, active.values)
    for active in model.effects:
        kept.setdefault(active.effect.name, active)
    for effect in s.offered:
        if effect.name in named and effect.name not in kept:
            params = {name: np.array(value) for name, value in absent_values(effect, s.n).items()}
            for (name, parameter, joint), value in state.shared.items():
                if name == effect.name:
                    params[parameter][max(joint, 0)] += value
            params |= {name: np.asarray(value) for name, value in state.active.get(effect.name, {}).items()}
            if any(np.any(params[name] != value) for name, value in absent_values(effect, s.n).items()):
                kept[effect.name] = ActiveEffect(effect, params)
    clipped = {name: _within(name, value) for name, value in p.named().items() if value is not None}
    found = replace(model, parameters=replace(p, **clipped), effects=tuple(kept.values()))
    given = model.values()
    changed = [name for name, value in found.values().items() if name not in given or np.any(value != given[name])]
    return replace(found, sources=dict(model.sources) | dict.fromkeys(changed, _SOURCE))


def _within(name: str, value: Array) -> Array:
    spec = PARAMETERS[name]
    return np.asarray(np.clip(np.asarray(value, dtype=float), spec.lower, spec.upper))
