"""Do recorded tensions hold from row to row, as commands do, or change linearly, as measured ones? The data say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from continuum.dynamics.simulator import Simulator
from continuum.identification.fit import fit
from continuum.identification.free import Free
from continuum.identification.noise import Noise
from continuum.identification.recording import Recording

_ITERATIONS = 3


def with_likelier_rows(
    simulator: Simulator, recordings: Sequence[Recording], noise: Noise, free: Sequence[Free]
) -> tuple[Recording, ...]:
    """The recordings, their tensions held or linear, whichever lets the model come nearer.

    The most moved of the driven runs decides for all: half a sample's delay shows in it.
    """
    driven = [recording for recording in recordings if recording.is_driven]
    if not driven:
        return tuple(recordings)
    judge = max(driven, key=lambda recording: recording.times.size)
    costs = {
        held: fit(simulator, [_held(judge, held)], noise, free, iterations=_ITERATIONS).cost for held in (True, False)
    }
    return tuple(_held(recording, min(costs, key=lambda held: costs[held])) for recording in recordings)


def _held(recording: Recording, held: bool) -> Recording:
    if recording.tensions is None:
        return recording
    return replace(recording, tensions=replace(recording.tensions, held=held))
