"""Values of the model and of the effects, with 95 % intervals from the fit by open-loop simulations."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from continuum.arrays import Array
from continuum.discovery.coordinates import PARAMETER
from continuum.discovery.fit_result import Fitted
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.problem import Problem, point_of
from continuum.discovery.unknowns import Unknown
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import PARAMETERS, Parameter
from continuum.identification.estimate import Z_95, Estimate

_IN_PARAMETERS = ("viscous", "coulomb")  # kinds of coordinates that are changes of a parameter
_SHOWN = ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")


def estimates_of(problem: Problem, fit: Fitted, hypothesis: Hypothesis) -> tuple[Estimate, ...]:
    """Return the values of one effect of a set."""
    effect = effect_named(hypothesis.effect)
    out = list[Estimate]()
    for one, value, sd in zip(fit.unknowns.common, fit.values.common, fit.sd, strict=True):
        if one.hypothesis is not hypothesis:
            continue
        if hypothesis.is_refit:
            out += _lacking(problem, fit, one, float(sd))
        else:
            out += _estimates(effect.parameters, one, float(value), float(sd))
    for run, those, values, per_run_sds in zip(
        problem.runs, fit.unknowns.per_run, fit.values.per_run, fit.per_run_sd, strict=True
    ):
        for one, value, sd in zip(those, values, per_run_sds, strict=True):
            if one.hypothesis is hypothesis:
                out += _estimates(effect.parameters, one, float(value), float(sd), run.name)
    return tuple(out)


def _lacking(problem: Problem, fit: Fitted, one: Unknown, sd: float) -> list[Estimate]:
    """Return the estimate of a parameter that the model file lacks; none if the coordinate is no parameter."""
    ((_, kind, joint),) = one.places
    name, step = PARAMETER[kind], float(problem.coordinates.steps[kind][joint])
    if kind not in _IN_PARAMETERS:
        return []
    value = float(point_of(problem, fit.state).values[problem.structure.slots[name]][joint])
    low, high = max(value - Z_95 * sd * step, 0.0), value + Z_95 * sd * step
    spec = PARAMETERS[name]
    return [Estimate(name, joint, "", value, low, high, spec.unit, spec.meaning, 0.0, spec.lower, spec.upper)]


def _estimates(spec: Mapping[str, Parameter], one: Unknown, value: float, sd: float, run: str = "") -> list[Estimate]:
    """Return an estimate of each parameter that an unknown changes; only one if it changes all joints alike."""
    found = []
    effect = next(iter(one.places))[0]
    for name in dict.fromkeys(name for _, name, _ in one.places):
        joints = [joint for _, parameter, joint in one.places if parameter == name]
        factor = next(factor for (_, parameter, _), factor in one.places.items() if parameter == name)
        joint = joints[0] if len(joints) == 1 and joints[0] >= 0 else None
        ends = [value - Z_95 * sd, value, value + Z_95 * sd]
        origin = spec[name].default or 0.0
        low, middle, high = np.exp(ends) if one.is_log else (origin + factor * end for end in ends)
        what = spec[name]
        found.append(
            Estimate(
                f"{effect}.{name}", joint, run, middle, low, high, what.unit, what.meaning,
                origin, what.lower, what.upper,
            )
        )  # fmt: skip
    return found


def baseline_estimates(problem: Problem, fit: Fitted) -> tuple[Estimate, ...]:
    """Return the fitted springs and friction of the model, each as the mean over joints."""
    values, slots = point_of(problem, fit.state).values, problem.structure.slots
    given, found = problem.structure.given.values(), list[Estimate]()
    for name in _SHOWN:
        spec, start = PARAMETERS[name], float(np.mean(given[name]))
        value = float(np.mean(values[slots[name]]))
        found.append(
            Estimate(name, None, "", value, np.nan, np.nan, spec.unit, spec.meaning, start, spec.lower, spec.upper)
        )
    return tuple(found)


def correlation_of(fit: Fitted) -> tuple[tuple[str, ...], Array]:
    """Return the names of a fit's values common to all recordings and their posterior correlations, (k, k).

    Ordinary differences between parts are left out.
    """
    used = [k for k, one in enumerate(fit.unknowns.common) if one.hypothesis is not None or _is_refit(one)]
    return tuple(_name(fit.unknowns.common[k]) for k in used), fit.correlation[np.ix_(used, used)]


def _is_refit(one: Unknown) -> bool:
    return all(not effect for effect, _, _ in one.places)


def _name(one: Unknown) -> str:
    effect, name, _ = next(iter(one.places))
    joints = [joint for _, _, joint in one.places if joint >= 0]
    where = f"[{joints[0] + 1}]" if len(joints) == 1 else ""
    return (f"{effect}.{name}" if effect else PARAMETER[name]) + where
