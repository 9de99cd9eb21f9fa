"""A run simulated freely from its first instant to its last: what a simulation without hints would show."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.reading import Reading
from continuum.dynamics.simulator import Simulator
from continuum.identification.fit import fit
from continuum.identification.free import Free
from continuum.identification.noise import Noise
from continuum.identification.window_residual import WindowResidual
from continuum.identification.windows import usual_length, window_rows
from continuum.recordings.recording import Recording

_ITERATIONS = 6


@dataclass(frozen=True)
class FreeRun:
    """A run that is ready to be simulated: as one window, from where it began."""

    whole: WindowResidual
    shared: Array
    first: Array

    def simulate(self) -> Reading | None:
        """What the sensors would read; None where the model cannot be simulated."""
        return self.whole.simulate(self.shared, [self.first])


def begun(simulator: Simulator, recording: Recording, noise: Noise, own: tuple[Free, ...] = ()) -> FreeRun | None:
    """A run and its beginning; None where the model cannot be simulated.

    Angles and rates at the first instant are those that explain the first window best, no later one; what belongs to a
    recording alone, as a sensor's offset, is fitted to it.

    Args:
        simulator: of the model.
        recording: what was measured.
        noise: of the sensors.
        own: unknowns that the recording has for itself.
    """
    mine = [Free(unknown.name, unknown.joint, 0) for unknown in own]
    fitted = fit(simulator, [recording if mine else _first_window(recording)], noise, mine, iterations=_ITERATIONS)
    if not fitted.parts:
        return None
    whole, shared = WindowResidual(simulator, recording, 0, noise, fitted.space, None), fitted.coordinates
    motion = fitted.runs[0].motion(0, shared, fitted.unknowns.own[0])
    first = np.concatenate([whole.from_state(0, shared, motion), fitted.unknowns.own[0][motion.size :]])
    return FreeRun(whole, shared, first)


def free_run(simulator: Simulator, recording: Recording, noise: Noise, own: tuple[Free, ...] = ()) -> Reading | None:
    """What the sensors would read from its beginning on; arguments are those of `begun`."""
    run = begun(simulator, recording, noise, own)
    return None if run is None else run.simulate()


def _first_window(recording: Recording) -> Recording:
    return recording.rows(window_rows(recording, usual_length(recording))[0])
