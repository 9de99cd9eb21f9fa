"""One extension of the model fitted to all runs, and to each half of them to predict the other half."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import Extension, beginning, extended, unknowns_of
from continuum.discovery.structure_left import StructureLeft, structure_left
from continuum.dynamics.model import Model
from continuum.dynamics.simulator import Simulator
from continuum.identification.arrow_least_squares import FitStatus
from continuum.identification.dataset import Split
from continuum.identification.fit import Fit, fit, predict
from continuum.identification.free import Free
from continuum.identification.noise import Noise
from continuum.identification.recording import Recording

_BLOCKS = 8


@dataclass(frozen=True)
class Question:
    """What all trials of a diagnosis share.

    Attributes:
        model: Eq. 12 with nominal values.
        baseline: unknowns that are fitted in any case.
        recordings: of the dataset.
        split: the same, in two halves.
        noise: of the sensors.
    """

    model: Model
    baseline: tuple[Free, ...]
    recordings: tuple[Recording, ...]
    split: Split
    noise: Noise


@dataclass(frozen=True)
class Trial:
    """How well one extension does.

    Attributes:
        extension: what was tried.
        status: of the fit to all runs.
        free: all shared unknowns; coordinates: where they ended, (k,).
        own: coordinates of each run's own unknowns.
        misfit: sum of squared errors of the fit to all runs, in units of the noise.
        n_errors: how many errors that are.
        held_out: the same for every run when the half without it was fitted, by stretches of
            time, (n_runs, n_blocks); runs in the order of the split.
        structure: what the fit to all runs leaves.
        simulations: how many runs were simulated.
    """

    extension: Extension
    status: FitStatus
    free: tuple[Free, ...]
    coordinates: Array
    own: tuple[Array, ...]
    misfit: float
    n_errors: int
    held_out: Array
    structure: StructureLeft
    simulations: int


def full_fit(
    question: Question, extension: Extension, start: Array | None = None, own: Sequence[Array] | None = None
) -> Fit:
    """The extension fitted to all runs."""
    model = extended(question.model, extension)
    free = [*question.baseline, *unknowns_of(question.model, extension)]
    begin = beginning(model, free) if start is None else start
    return fit(Simulator(model), question.recordings, question.noise, free, begin, own)


def judged(question: Question, extension: Extension, whole: Fit) -> Trial:
    """The trial of an extension whose fit to all runs is known."""
    free = [*whole.free, *whole.runs[0].own.unknowns]
    held_out: list[Array] = []
    simulations = whole.simulations
    for split in (question.split.swapped, question.split):
        half = fit(whole.simulator, split.identification, question.noise, free, whole.coordinates)
        there = predict(half, split.validation, question.noise)
        simulations += half.simulations + there.simulations
        held_out += [_by_stretches(there, i) for i in range(len(split.validation))]
    errors = [whole.errors(i) for i in range(len(whole.runs))]
    shared = whole.coordinates.size / len(whole.runs)
    structure = structure_left(
        errors, [r.times for r in question.recordings], whole.unknowns.own[0].size + shared
    )
    return Trial(
        extension,
        whole.status,
        whole.free,
        whole.coordinates,
        tuple(whole.unknowns.own),
        float(whole.misfits.sum()),
        sum(part.errors.size for part in whole.parts),
        np.stack(held_out),
        structure,
        simulations,
    )


def _by_stretches(predicted: Fit, run: int) -> Array:
    """Squared errors of a run summed over stretches of time, (n_blocks,); infinite where it cannot be simulated."""
    if not predicted.parts:
        return np.full(_BLOCKS, np.inf)
    errors = predicted.errors(run)
    by_time = (errors.angle**2).sum(axis=1)
    if errors.rate is not None:
        by_time = by_time + (errors.rate**2).sum(axis=1)
    return np.array([stretch.sum() for stretch in np.array_split(by_time, _BLOCKS)])
