"""Fit a model to recordings: free simulation, exact slopes, every run's initial state among the unknowns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.reading import Reading
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_slots, with_vector
from continuum.identification.arrow_least_squares import (
    FitStatus,
    RunPart,
    Unknowns,
    arrow_least_squares,
    shared_information,
)
from continuum.identification.free import Free, FreeSpace, is_per_recording
from continuum.identification.noise import Noise
from continuum.identification.recording import Recording
from continuum.identification.run_residual import Errors, RunResidual

THESIS_PARAMETERS = ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")
"""What the thesis identified (chapter 3.3), each common to all joints."""


@dataclass(frozen=True)
class Fit:
    """A fitted model.

    Attributes:
        status: how the fit ended; unless CONVERGED the rest is the best that was found.
        runs: residuals of the recordings.
        unknowns: prior and bounds; its start is where the fit ended.
        parts: errors and slopes of every run where the fit ended.
        cost: minus the logarithm of likelihood and prior.
        simulations: how many runs were simulated, those with slopes counted once.
    """

    status: FitStatus
    simulator: Simulator
    runs: Sequence[RunResidual]
    unknowns: Unknowns
    parts: Sequence[RunPart]
    cost: float
    simulations: int

    @property
    def free(self) -> tuple[Free, ...]:
        """The shared unknowns."""
        return self.runs[0].shared.unknowns

    @property
    def coordinates(self) -> Array:
        """Where the shared unknowns ended, (k,)."""
        return self.unknowns.shared

    @cached_property
    def model(self) -> Model:
        """The model with its shared values fitted; what belongs to single recordings is left at its origin."""
        return with_vector(self.simulator.model, self.runs[0].shared.values(self.coordinates))

    @property
    def misfits(self) -> Array:
        """Sum of the squared errors of each run in units of the noise, (n_runs,)."""
        return np.array([float(part.errors @ part.errors) for part in self.parts])

    @cached_property
    def information(self) -> Array:
        """Fisher information of the shared coordinates, (k, k), with prior."""
        return shared_information(self.unknowns, self.parts)

    def errors(self, run: int) -> Errors:
        """Errors of one run by time and joint."""
        residual = self.runs[run]
        flat, shape = self.parts[run].errors, residual.recording.theta.shape
        size = residual.recording.theta.size
        return Errors(flat[:size].reshape(shape), flat[size:].reshape(shape) if flat.size > size else None)

    def simulated(self, run: int) -> Reading | None:
        """What the sensors would read in one run."""
        return self.runs[run].simulate(self.coordinates, self.unknowns.own[run])

    def value(self, unknown: Free) -> float:
        """Fitted value of a shared unknown, in its parameter's unit."""
        slot = parameter_slots(self.model)[unknown.name]
        values = self.runs[0].shared.values(self.coordinates)[slot]
        return float(values[unknown.joint or 0])

    @property
    def standard_deviations(self) -> Array:
        """Of the shared unknowns in their own units, (k,), if all errors are noise; else see `bootstrap`."""
        return self.runs[0].shared.scale * np.sqrt(np.diag(np.linalg.inv(self.information)))


def fit(
    simulator: Simulator,
    recordings: Sequence[Recording],
    noise: Noise,
    free: Sequence[Free],
    start: Array | None = None,
    own: Sequence[Array] | None = None,
) -> Fit:
    """Fit the unknowns ``free`` of a model, and the initial state of every recording.

    Args:
        simulator: of the model; its values are the centre of the prior.
        recordings: what was measured, at least one.
        noise: of the sensors.
        free: unknowns; those of parameters that differ by recording get a value in each.
        start: coordinates of the shared ones to start from, (k,); the model's own values without.
        own: coordinates of each recording's own unknowns to start from.

    Raises:
        InvalidValueError: an unknown that the model does not have.
    """
    model = simulator.model
    shared = FreeSpace(model, [unknown for unknown in free if not is_per_recording(model, unknown)])
    mine = FreeSpace(model, [unknown for unknown in free if is_per_recording(model, unknown)])
    runs = [RunResidual(simulator, recording, noise, shared, mine) for recording in recordings]
    begin = np.zeros(len(shared.unknowns)) if start is None else shared.clipped(start)
    unknowns = Unknowns(
        begin,
        shared.spread,
        shared.lower,
        shared.upper,
        [run.start for run in runs],
        [run.spread for run in runs],
    )

    def evaluate(at: Array, owns: Sequence[Array]) -> list[RunPart] | None:
        parts: list[RunPart] = []
        for run, coordinates in zip(runs, owns, strict=True):
            part = run.part(at, coordinates)
            if part is None:
                return None
            parts.append(part)
        return parts

    found = arrow_least_squares(evaluate, unknowns, own)
    ended = replace(unknowns, shared=found.shared, own=list(found.own))
    return Fit(found.status, simulator, runs, ended, found.parts, found.cost, found.evaluations * len(runs))


def predict(fitted: Fit, recordings: Sequence[Recording], noise: Noise) -> Fit:
    """The fitted model on other recordings: only what belongs to each, its initial state above all, is fitted."""
    simulator = fitted.simulator.around(fitted.model)
    return fit(simulator, recordings, noise, fitted.runs[0].own.unknowns)
