"""The refitted model: springs and friction fitted to the recordings, before any effect is added."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from continuum.arrays import Array
from continuum.discovery.baseline import fitted_baseline, has_tension, problem_of, with_linear_inputs
from continuum.discovery.examination import Examined
from continuum.discovery.hand_measurement import HandMeasurement, known_whole
from continuum.discovery.output_error import OutputError
from continuum.discovery.problem import Problem, linearise
from continuum.discovery.search import Found
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model import Model, with_dry_friction
from continuum.errors import InvalidValueError
from continuum.estimation.structure import Structure
from continuum.recordings.cable_sides import refuse_swapped_cables
from continuum.recordings.recording import Recording

_STRETCH, _ONE_RUN = 10, 0.5
"""Rows of a stretch, and fraction of common stretches above which two recordings are one: noise and motions never
repeat, copies do."""


def check_recordings(recordings: Sequence[Recording], model: Model) -> None:
    """Check that a model can be fitted to recordings.

    Raises:
        InvalidValueError: no recording, a number of joints or kind of inputs other than the model's, swapped cables, or
            a recording given twice.
    """
    if not recordings:
        raise InvalidValueError("recordings", 0, "one or more")
    for number, one in enumerate(recordings):
        one.inputs_for(model)
        refuse_swapped_cables(one)
        for other in recordings[:number]:
            if _share_of_common_rows(one, other) > _ONE_RUN:
                raise InvalidValueError("recordings", f"{other.name} and {one.name}", "different runs, not copies")


def _share_of_common_rows(one: Recording, other: Recording) -> float:
    """Return the fraction of the shorter recording's distinct stretches of angles that the other one has too."""
    first, second = (np.unique(_stretches(run.theta), axis=0) for run in (one, other))
    both = np.unique(np.concatenate([first, second]), axis=0)
    return (len(first) + len(second) - len(both)) / min(len(first), len(second))


def _stretches(theta: Array) -> Array:
    """Return all stretches of some rows, (n_stretches, rows n) [rad]: single rows of rounded angles may coincide."""
    rows = min(_STRETCH, len(theta))
    return sliding_window_view(theta, rows, axis=0).reshape(len(theta) - rows + 1, -1)


def problem_for(
    recordings: Sequence[Recording],
    model: Model,
    effects: Sequence[str] | None = None,
    measured: Sequence[HandMeasurement] = (),
) -> Problem:
    """Return what stays fixed during a fit.

    Args:
        recordings: runs of the arm.
        model: model with nominal values and the values measured by hand.
        effects: names of the effects that may be added; all installed effects if None.
        measured: values of effects that were measured by hand.
    """
    dry, n = with_dry_friction(model), model.n_joints
    names = effect_names() if effects is None else effects
    offered = [name for name in names if not known_whole(effect_named(name), measured, n)]
    partly = {one.effect for one in measured}
    structure = Structure(dry, offered, has_tension(recordings, dry), partly)
    return replace(problem_of(structure, recordings), measured=tuple(measured))


def refit(problem: Problem, recordings: Sequence[Recording]) -> tuple[Examined, OutputError, OutputError | None]:
    """Refit the model alone, with inputs held from row to row or linear between rows, whichever simulates better.

    If the model file lacks friction, friction is added: without it, the errors are not informative.

    Returns:
        The baseline, the fits with these inputs, and the fits with the others, None if no input varies.
    """
    judge, found = OutputError(problem, tuple(recordings)), _smoothed(problem)
    fit, linear = judge.fit(found, ()), with_linear_inputs(problem)
    if linear is None:
        return Examined(found, fit), judge, None
    fit, other = fit if fit.settled else judge.further(found, fit), judge.around(linear)
    nearer = other.fit(found, [fit])
    if nearer.error < fit.error:
        found = _smoothed(linear)
        return Examined(found, other.fit(found, [nearer])), other, judge
    return Examined(found, fit), judge, other


def refitted(recordings: Sequence[Recording], model: Model) -> tuple[Examined, OutputError]:
    """Return the refitted model and the output-error fits of the recordings."""
    start, judge, _ = refit(problem_for(recordings, model), recordings)
    return start, judge


def _smoothed(problem: Problem) -> Found:
    """Return the model with the springs and the friction that the filter finds."""
    lin = linearise(problem, fitted_baseline(problem))
    return Found(lin, tuple(h for h in lin.library.hypotheses if h.is_refit))
