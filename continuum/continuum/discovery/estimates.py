"""Values of the model and of the effects, with 95 % intervals from the fit by open-loop simulations."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from continuum.discovery.coordinates import PARAMETER
from continuum.discovery.fitted import Fitted
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.problem import Problem, point_of
from continuum.discovery.result import Estimate
from continuum.discovery.unknowns import Unknown
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import PARAMETERS, Parameter

_Z = 1.96
_IN_PARAMETERS = ("viscous", "coulomb")  # kinds of coordinates that are a parameter's change
_SHOWN = ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")


def estimates_of(problem: Problem, fit: Fitted, hypothesis: Hypothesis) -> tuple[Estimate, ...]:
    """Values of one effect of a set."""
    effect = effect_named(hypothesis.effect)
    out = list[Estimate]()
    for one, value, sd in zip(fit.unknowns.common, fit.values.common, fit.sd, strict=True):
        if one.hypothesis is not hypothesis:
            continue
        if hypothesis.is_refit:
            out += _lacking(problem, fit, one, float(sd))
        else:
            out += _estimates(effect.parameters, one, float(value), float(sd))
    for run, those, values, own_sds in zip(problem.runs, fit.unknowns.own, fit.values.own, fit.own_sd, strict=True):
        for one, value, sd in zip(those, values, own_sds, strict=True):
            if one.hypothesis is hypothesis:
                out += _estimates(effect.parameters, one, float(value), float(sd), run.name)
    return tuple(out)


def _lacking(problem: Problem, fit: Fitted, one: Unknown, sd: float) -> list[Estimate]:
    """Of a parameter that the model file has none of."""
    ((_, kind, joint),) = one.places
    name, step = PARAMETER[kind], float(problem.coordinates.steps[kind][joint])
    if kind not in _IN_PARAMETERS:
        return []
    value = float(point_of(problem, fit.state).values[problem.structure.slots[name]][joint])
    low, high = max(value - _Z * sd * step, 0.0), value + _Z * sd * step
    return [Estimate(name, joint, "", value, low, high, PARAMETERS[name].unit, PARAMETERS[name].meaning)]


def _estimates(spec: Mapping[str, Parameter], one: Unknown, value: float, sd: float, run: str = "") -> list[Estimate]:
    """Of each parameter that an unknown moves; of one joint where it moves that of all joints alike."""
    found = []
    for name in dict.fromkeys(name for _, name, _ in one.places):
        joints = [joint for _, parameter, joint in one.places if parameter == name]
        factor = next(factor for (_, parameter, _), factor in one.places.items() if parameter == name)
        joint = joints[0] if len(joints) == 1 and joints[0] >= 0 else None
        ends = [value - _Z * sd, value, value + _Z * sd]
        origin = spec[name].default or 0.0
        low, middle, high = np.exp(ends) if one.is_log else (origin + factor * end for end in ends)
        label = f"{next(iter(one.places))[0]}.{name}"
        found.append(Estimate(label, joint, run, middle, low, high, spec[name].unit, spec[name].meaning))
    return found


def baseline_estimates(problem: Problem, fit: Fitted) -> tuple[Estimate, ...]:
    """The model's own springs and friction as fitted, the mean over joints."""
    values, slots = point_of(problem, fit.state).values, problem.structure.slots
    return tuple(
        Estimate(
            name, None, "", float(np.mean(values[slots[name]])), np.nan, np.nan, PARAMETERS[name].unit,
            PARAMETERS[name].meaning,
        )
        for name in _SHOWN
    )  # fmt: skip
