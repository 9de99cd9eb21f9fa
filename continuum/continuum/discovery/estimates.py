"""Values of the model and of the effects, with 95 % intervals from the posterior's curvature."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from continuum.discovery.candidates import Examined
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.problem import Problem, point_of
from continuum.discovery.result import Estimate
from continuum.dynamics.effect import Effect
from continuum.dynamics.parameters import PARAMETERS

_Z = 1.96
_SHOWN = ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")


def estimates_of(problem: Problem, one: Examined, hypothesis: Hypothesis) -> tuple[Estimate, ...]:
    """Values of one effect of a set."""
    found, state = one.found, one.found.lin.state
    level = found.lin.evidence.best_level(found.chosen)
    best = found.lin.evidence.optimum(found.chosen, level)
    effect = next(e for e in problem.structure.offered if e.name == hypothesis.effect)
    spec, at, out = effect.parameters, 0, []
    for h in found.chosen:
        if h is hypothesis:
            break
        at += len(h.coefficients)
    size, ratio = max(float(best.values[at]), 0.2) if hypothesis.coefficients else 1.0, np.log(found.lin.library.ratio)
    for k, c in enumerate(hypothesis.coefficients):
        value, sd, joint = (
            float(best.values[at + k]),
            float(best.sd[at + k]),
            c.joints[0] if len(c.joints) == 1 else None,
        )
        if c.kind == "slot":
            parts = [(c.parameter, 1.0)]
            if effect.directions and hypothesis.weights:
                parts = _direction(hypothesis, effect.directions)
            for name, factor in parts:
                origin = spec[name].default or 0.0
                out.append(_estimate(effect, name, joint, origin + factor * value, factor * sd))
        elif hypothesis.start is not None:
            own = state.active.get(effect.name, hypothesis.start)
            where = joint or 0
            if c.kind == "log":
                now = float(np.atleast_1d(own[c.parameter])[where if spec[c.parameter].per_joint else 0])
                now *= float(np.exp(ratio * np.clip(value / size, -1.5, 1.5)))
                out.append(_estimate(effect, c.parameter, joint, now, now * ratio * sd / size))
    keys = {column: key for key, column in found.lin.library.at.items()}
    for r, run in enumerate(problem.runs):
        for i, column in enumerate(best.local_columns):
            if int(column) in hypothesis.local and keys.get(int(column), ("",))[0] == effect.name:
                _, name, j = keys[int(column)]
                sd = _local_sd(one, r, level, i)
                out.append(_estimate(effect, name, j if j >= 0 else None, float(best.local[r, i]), sd, run.name))
    return tuple(out)


def _direction(h: Hypothesis, directions: Sequence[Mapping[str, float]]) -> list[tuple[str, float]]:
    """Parameters and factors of the combination that a hypothesis stands for."""
    factors = h.weights[0][:: len(h.joints or (0,))]
    return list(next(one for one in directions if tuple(one.values()) == factors).items())


def _local_sd(one: Examined, run: int, level: int, i: int) -> float:
    lin = one.found.lin
    local = np.array([c for h in one.found.chosen for c in h.local], dtype=int)
    sd = np.array([s for h in one.found.chosen for s in h.local_sd])
    A = lin.evidence.runs[level][run].L[np.ix_(local, local)] + np.diag(sd**-2.0)
    return float(np.sqrt(np.linalg.inv(A)[i, i]))


def baseline_estimates(problem: Problem, one: Examined) -> tuple[Estimate, ...]:
    """The model's own springs and friction as refitted, the mean over joints."""
    values, slots = point_of(problem, one.simulable).values, problem.structure.slots
    return tuple(
        Estimate(
            name,
            None,
            "",
            float(np.mean(values[slots[name]])),
            np.nan,
            np.nan,
            PARAMETERS[name].unit,
            PARAMETERS[name].meaning,
        )
        for name in _SHOWN
    )


def _estimate(effect: Effect, name: str, joint: int | None, value: float, sd: float, run: str = "") -> Estimate:
    spec, half = effect.parameters[name], _Z * abs(sd)
    return Estimate(f"{effect.name}.{name}", joint, run, value, value - half, value + half, spec.unit, spec.meaning)
