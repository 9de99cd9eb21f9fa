"""Identification of springs and friction by output error: thesis 3.3 with a likelihood in place of its objective.

Segments of the recordings are simulated open loop by Eq. 12 from unknown initial states (segmented output error).
Parts of one batch differ by a few percent, so joints differ slightly about common values; with ``per_joint``, little is
assumed about their differences.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import Key
from continuum.discovery.candidates import silent
from continuum.discovery.coordinates import PARAMETER
from continuum.discovery.decision import noise_limit
from continuum.discovery.extended_model import model_of
from continuum.discovery.fit_result import Fitted
from continuum.discovery.problem import Problem
from continuum.discovery.refit import check_recordings, refitted
from continuum.discovery.search import Found, Progress
from continuum.dynamics.model import Model
from continuum.dynamics.parameters import PARAMETERS
from continuum.estimation.sensor_noise import white_noise_error
from continuum.identification.estimate import Z_95, Estimate
from continuum.identification.free import THESIS_PARAMETERS
from continuum.identification.identified import Identified, with_identified
from continuum.languages import Message
from continuum.recordings.recording import Recording

_DIFFERENCES = {
    ("joint_stiffness", "excess"): "stiffness",
    ("joint_friction", "viscous"): "viscous_friction",
    ("joint_friction", "coulomb"): "coulomb_friction",
}
"""Values by which a joint differs from the others, and the parameter that each changes."""
_FREE = 0.5
"""Relative prior standard deviation of such a difference if little is known of it."""
_LITTLE = 0.5
"""Fraction of its prior variance above which a value counts as undetermined by the recordings."""
_STEP = 1e-3  # standard deviations, for finite differences


def fit_parameters(
    recordings: Sequence[Recording], model: Model, per_joint: bool = False, progress: Progress = silent
) -> Identified:
    """Identify the thesis's five parameters.

    Args:
        recordings: runs to fit.
        model: model with nominal values; the fit starts from its springs and friction.
        per_joint: whether every joint has a separate spring, viscous and Coulomb friction; all joints share the
            Stribeck effect.
        progress: called with the current step and the fraction of all work that is done.

    Raises:
        InvalidValueError: no recording, a recording twice, or recordings that do not fit the model.
    """
    check_recordings(recordings, model)
    progress(Message("smoothing"), 0.0)
    start, judge = refitted(recordings, model)
    progress(Message("fitting from several starts"), 0.3)
    found, fit = start.found, judge.multi_start(start.found)
    if per_joint:  # for a joint that hardly swings, only the common values are a good start
        found = _with_free_joints(found)
        fit = judge.multi_start(found, [fit])
    progress(Message("fitting all segments"), 0.8)
    fit = judge.along(judge.problem, recordings).followed(found, fit.start, None)
    singly = {PARAMETER[name] for name, joint in judge.problem.coordinates.all if joint >= 0}
    key = tuple(h.key for h in found.chosen)
    values = _estimates(judge.problem, fit, key, model, singly | set(_DIFFERENCES.values()) if per_joint else singly)
    limit = noise_limit(judge.floor, fit.observations, white_noise_error(judge.problem.runs))
    return Identified(
        Message("output error"), with_identified(model, values, "identified from recordings by output error"), values,
        fit.error / judge.floor, limit / judge.floor, _undetermined(fit),
    )  # fmt: skip


def _with_free_joints(found: Found) -> Found:
    """Return the same set with wide priors on differences of springs and friction between joints."""
    library = copy(found.lin.library)
    free = {column for (effect, name, _), column in library.at.items() if (effect, name) in _DIFFERENCES}
    library.ordinary = [(column, _FREE if column in free else sd) for column, sd in library.ordinary]
    return replace(found, lin=replace(found.lin, library=library))


def _estimates(problem: Problem, fit: Fitted, key: Key, model: Model, singly: Collection[str]) -> tuple[Estimate, ...]:
    """Return the values with intervals, of single joints or means over joints, linearised about the fit."""

    def values(common: Array) -> Array:
        """Return the parameters of all joints, (n_parameters, n)."""
        state = fit.unknowns.state(common, fit.values.per_run)
        found = model_of(problem, state, key, model).values()
        return np.stack([np.broadcast_to(found[name], (problem.structure.n,)) for name in THESIS_PARAMETERS])

    here, sd = values(fit.values.common), fit.sd
    sensitivities = [(values(fit.values.common + step) - here) / _STEP for step in _STEP * np.diag(sd)]
    J = np.stack(sensitivities, axis=-1)  # by unknowns in units of their standard deviations
    given, found = model.values(), list[Estimate]()
    for name, value, by_unknowns in zip(THESIS_PARAMETERS, here, J, strict=True):
        spec, start = PARAMETERS[name], np.broadcast_to(given[name], (problem.structure.n,))
        joints = [*range(problem.structure.n)] if name in singly else [None]
        for joint in joints:
            which = slice(None) if joint is None else slice(joint, joint + 1)
            g = by_unknowns[which].mean(axis=0)
            half, middle = Z_95 * float(np.sqrt(g @ fit.correlation @ g)), float(value[which].mean())
            low, high = max(middle - half, spec.lower), min(middle + half, spec.upper)
            found.append(
                Estimate(
                    name, joint, "", middle, low, high, spec.unit, spec.meaning, float(start[which].mean()), spec.lower,
                    spec.upper,
                )
            )  # fmt: skip
    return tuple(found)


def _undetermined(fit: Fitted) -> tuple[str, ...]:
    """Return the parameters whose coordinate keeps more than half of its prior variance."""
    found = [
        PARAMETER[name]
        for one, sd in zip(fit.unknowns.common, fit.sd, strict=True)
        for effect, name, _ in one.places
        if not effect and sd**2 > _LITTLE * one.sd**2
    ]
    return tuple(dict.fromkeys(found))
