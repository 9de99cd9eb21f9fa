"""States of a fit with one more effect of typical size, for effects with states, delays and shapes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.problem import Problem, State


def typical_states(problem: Problem, state: State, library: Library) -> Iterator[tuple[Hypothesis, State]]:
    """Yield each hypothesis that is not linear in its size and not in the state, and the state with it.

    Effects that are screened at several sizes or shapes have the one closest to typical.
    """
    offered, chosen = {effect.name: effect for effect in problem.structure.offered}, dict[object, Hypothesis]()
    for h in library.hypotheses:
        if h.start is None or h.effect in state.active:
            continue
        if h.key not in chosen or _departure(problem, h) < _departure(problem, chosen[h.key]):
            chosen[h.key] = h
    for h in chosen.values():
        if h.coefficients[0].kind == "value":
            yield h, replace(state, active={**state.active, h.effect: h.start or {}})
            continue
        spec = offered[h.effect].parameters
        shared = {(h.effect, c.parameter, joint): spec[c.parameter].typical or 1.0
                  for c in h.coefficients for joint in c.joints or (-1,)}  # fmt: skip
        for name, value in (h.start or {}).items():
            shared[(h.effect, name, -1)] = float(value[0]) - (spec[name].default or 0.0)
        yield h, replace(state, shared={**state.shared, **shared})


def _departure(problem: Problem, h: Hypothesis) -> float:
    """Return the distance of an effect's values from typical ones, or from the defaults of its shape, in logarithms."""
    effect = next(e for e in problem.structure.offered if e.name == h.effect)
    out = 0.0
    for name, value in (h.start or {}).items():
        spec, size = effect.parameters[name], float(np.max(np.abs(value)))
        usual = spec.default or spec.typical or 1.0
        out += abs(np.log(max(size, 1e-12) / usual)) if size > 0 else 0.0
    return out
