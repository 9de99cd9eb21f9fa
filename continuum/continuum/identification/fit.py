"""Fit a model to recordings: windows simulated with exact slopes, every window's first state among the unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_slots, with_vector
from continuum.identification.arrow_least_squares import (
    FitStatus,
    Part,
    Unknowns,
    arrow_least_squares,
    misfit_of,
    shared_information,
)
from continuum.identification.free import Free, FreeSpace
from continuum.identification.likeliest import likeliest
from continuum.identification.noise import Noise
from continuum.identification.window_residual import WindowAt, WindowResidual
from continuum.identification.window_settling import STEPS, descended
from continuum.identification.windows import usual_length
from continuum.recordings.recording import Recording

THESIS_PARAMETERS = ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")
"""What the thesis identified (chapter 3.3), each common to all joints."""


@dataclass(frozen=True)
class Fit:
    """A fitted model.

    Attributes:
        status: how the fit ended; unless CONVERGED the rest is the best that was found.
        simulator: of the model, its values at the origin.
        space: the shared unknowns.
        runs: residuals of the recordings.
        unknowns: where the fit ended, prior and bounds.
        parts: errors and slopes of every window there, run after run.
        cost: minus the logarithm of likelihood and prior.
        simulations: how many runs were simulated with slopes, windows of single runs summed up to whole ones.
        promised: by how much the cost would fall with more iterations, were the errors linear.
    """

    status: FitStatus
    simulator: Simulator
    space: FreeSpace
    runs: Sequence[WindowResidual]
    unknowns: Unknowns
    parts: Sequence[Part]
    cost: float
    simulations: int
    promised: float = 0.0

    @property
    def coordinates(self) -> Array:
        """Where the shared unknowns ended, (k,)."""
        return self.unknowns.shared

    @cached_property
    def model(self) -> Model:
        """The model with its common values fitted; what belongs to single recordings is left out."""
        return with_vector(self.simulator.model, self.space.common_values(self.coordinates))

    def model_of(self, recording: int) -> Model:
        """The model as it is in one recording, by number, with what that recording has for itself."""
        return with_vector(self.simulator.model, self.space.values_of(recording, self.coordinates))

    @property
    def misfits(self) -> list[Array]:
        """Misfit of each window of each run; of a right model about the number of its errors."""
        found = iter(self.parts)
        return [np.array([misfit_of(next(found)) for _ in run.rows]) for run in self.runs]

    @property
    def n_errors(self) -> int:
        """How many numbers were measured."""
        return sum(part.errors.size for part in self.parts)

    @cached_property
    def information(self) -> Array:
        """Fisher information of the shared coordinates, (k, k), with prior."""
        return shared_information(self.unknowns, self.parts)

    def value(self, unknown: Free) -> float:
        """Fitted value of an unknown that all recordings share, in its parameter's unit."""
        slot = parameter_slots(self.model)[unknown.name]
        return float(self.space.common_values(self.coordinates)[slot][unknown.joint or 0])


def fit(
    simulator: Simulator,
    recordings: Sequence[Recording],
    noise: Noise,
    free: Sequence[Free],
    start: Array | None = None,
    length: float | None = 0.0,
    iterations: int = 30,
    own: Sequence[Array] | None = None,
    seekings: int = 2,
    steps: int = STEPS,
    to_the_end: bool = False,
) -> Fit:
    """Fit the unknowns ``free`` of a model, and the first state of every window.

    Args:
        simulator: of the model; its values are the centre of the prior.
        recordings: what was measured, at least one.
        noise: of the sensors.
        free: unknowns.
        start: coordinates to start from, (k,); the model's own values without.
        length: of the windows [s]; 0 for the usual one, None for one window a run.
        iterations: at most so many.
        own: coordinates of each window's own unknowns to start from, run after run, those of its joints at least; as
            measured without.
        seekings: how often first states of windows that fit badly are sought anew, at most.
        steps: of each window's first state at every iteration, at most.
        to_the_end: go on where the cost hardly falls, for the values' sake.

    Raises:
        InvalidValueError: an unknown that the model does not have.
    """
    space = FreeSpace(simulator.model, free)
    runs = [
        WindowResidual(simulator, recording, i, noise, space, usual_length(recording) if length == 0.0 else length)
        for i, recording in enumerate(recordings)
    ]
    first = _begun([coordinates for run in runs for coordinates in run.start], own)
    begin = np.zeros(len(space.unknowns)) if start is None else space.clipped(start)
    begin = likeliest(space, simulator.model, begin) if to_the_end else begin
    unknowns = Unknowns(
        begin, space.spread, space.lower, space.upper, first, [spread for run in runs for spread in run.spreads]
    )

    def evaluate(shared: Array, owns: Sequence[Array], anew: bool) -> tuple[list[Part], list[Array]] | None:
        windows: list[WindowAt] = []
        for run in runs:
            found = descended(run, shared, owns[len(windows) : len(windows) + len(run.rows)], anew, steps)
            if found is None:
                return None
            windows += found
        return [at.part for at in windows], [at.own for at in windows]

    found = arrow_least_squares(evaluate, unknowns, iterations, seekings, to_the_end)
    ended = replace(unknowns, shared=found.shared, own=list(found.own))
    simulations = round(sum(run.windows_simulated / len(run.rows) for run in runs))
    return Fit(found.status, simulator, space, runs, ended, found.parts, found.cost, simulations, found.promised)


def _begun(start: Sequence[Array], own: Sequence[Array] | None) -> list[Array]:
    """Coordinates to start from, of windows whose effects may have other states than where ``own`` is from."""
    if own is None:
        return list(start)
    return [
        mine if mine.size == usual.size else np.concatenate([mine, usual[mine.size :]])[: usual.size]
        for usual, mine in zip(start, own, strict=True)
    ]
