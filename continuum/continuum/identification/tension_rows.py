"""Do recorded tensions hold from row to row, as commands do, or change linearly, as measured ones? The data say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.dynamics.simulator import Simulator
from continuum.identification.fit import Fit, fit
from continuum.identification.free import Free
from continuum.identification.noise import Noise
from continuum.identification.recording import Recording

_ITERATIONS = 3


def with_likelier_rows(
    simulator: Simulator, recordings: Sequence[Recording], noise: Noise, free: Sequence[Free]
) -> tuple[Recording, ...]:
    """The recordings, their tensions held or linear, whichever lets the model come nearer.

    The most moved of the driven runs decides for all: half a sample's delay shows in it, in few windows but by much.
    """
    driven = [recording for recording in recordings if recording.is_driven]
    if not driven:
        return tuple(recordings)
    judge = max(driven, key=lambda recording: recording.times.size)
    fits = {held: fit(simulator, [_held(judge, held)], noise, free, iterations=_ITERATIONS) for held in (True, False)}
    likelier = min(fits, key=lambda held: _strangeness(fits[held]))
    return tuple(_held(recording, likelier) for recording in recordings)


def _strangeness(fitted: Fit) -> float:
    """Sum over the windows of the logarithm of their squared errors, which few bad windows do not rule."""
    return sum(part.errors.size * float(np.log1p(np.mean(part.errors**2))) for part in fitted.parts)


def _held(recording: Recording, held: bool) -> Recording:
    if recording.tensions is None:
        return recording
    return replace(recording, tensions=replace(recording.tensions, held=held))
