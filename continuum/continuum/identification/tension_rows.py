"""Do recorded tensions hold from row to row, as commands do, or change linearly, as measured ones? The data say.

Where a tension jumps, joints tell it without any model: a tension that is held changes nothing before its row, one that
changes linearly has done half of its work by then. Smooth tensions are simulated both ways.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.simulator import Simulator
from continuum.identification.fit import Fit, fit
from continuum.identification.free import Free
from continuum.identification.noise import Noise
from continuum.recordings.recording import Recording

_JUMP, _STEEPER = 3.0, 3.0  # N from one row to the next, and times as much as in the rows beside it
_JOLT = 40.0  # rad/s2, by which arms answer at once
_LOUDER = 3.0  # than the change of acceleration before: joints that stick and slip jolt by themselves
_BEFORE = 0.2  # of the change of acceleration; about 0 for held tensions, 0.4 for linear ones
_ITERATIONS = 1
_RECORDINGS = 2  # that are asked
_MOVED = 0.15  # of the windows, those in which the tensions move most


def with_likelier_rows(
    simulator: Simulator, recordings: Sequence[Recording], noise: Noise, free: Sequence[Free]
) -> tuple[Recording, ...]:
    """The recordings, their tensions held or linear, whichever is likelier for all.

    Without jumps the windows in which the tensions move most decide: half a sample's delay shows in them.
    """
    driven = [recording for recording in recordings if recording.is_driven]
    shares = [share or 0.0 for recording in driven for share in _shares_before_jumps(recording)]
    if shares:
        return tuple(_held(recording, float(np.median(shares)) < _BEFORE) for recording in recordings)
    if not driven:
        return tuple(recordings)
    strange = {}
    for held in (True, False):
        asked = [_held(recording, held) for recording in driven[:_RECORDINGS]]
        strange[held] = _strangeness(fit(simulator, asked, noise, free, iterations=_ITERATIONS))
    return tuple(_held(recording, strange[True] <= strange[False]) for recording in recordings)


def jumps_tell(recordings: Sequence[Recording]) -> bool:
    """Whether jumps of the tensions tell it, without any model: whether joints felt any at once."""
    return any(share is not None for recording in recordings for share in _shares_before_jumps(recording))


def turned(recording: Recording) -> Recording:
    """The recording with its tensions the other way between rows."""
    return recording if recording.tensions is None else _held(recording, not recording.tensions.held)


def _shares_before_jumps(recording: Recording) -> list[float | None]:
    """Of every jump, which part of the change of acceleration came before its row; the fastest joints count most.

    None of a jump that no joint felt at once: what comes later than its row did not begin before it.
    """
    if recording.theta_rate is None or recording.tensions is None:
        return []
    if np.median(np.diff(recording.tensions.times)) > 1.5 * np.median(np.diff(recording.times)):
        return []  # much else may have happened since the row before
    u = np.array([recording.tensions.at(time) for time in recording.times])
    acceleration = np.diff(recording.theta_rate, axis=0) / np.diff(recording.times)[:, None]
    found: list[float | None] = []
    for row in _jumps(u):
        if 2 <= row < len(acceleration):
            before, after = (acceleration[k] - acceleration[row - 2] for k in (row - 1, row))
            usual = float(np.linalg.norm(acceleration[row - 2] - acceleration[max(row - 3, 0)]))
            felt = float(np.linalg.norm(after)) > max(_JOLT, _LOUDER * usual)
            found.append(float(before @ after / (after @ after)) if felt else None)
    return found


def _jumps(u: Array) -> list[int]:
    """Rows by which a tension has jumped, in ``u`` (n_rows, n_cables) [N]; on a ramp the rows beside move as much."""
    steps = np.pad(np.abs(np.diff(u, axis=0)), ((1, 1), (0, 0)))
    steep = (steps[1:-1] > _JUMP) & (steps[1:-1] > _STEEPER * np.maximum(steps[:-2], steps[2:]))
    return [int(row) + 1 for row in np.flatnonzero(steep.any(axis=1))]


def _strangeness(fitted: Fit) -> float:
    """Sum over the windows of the logarithm of their squared errors, which no single one rules.

    Infinite where the model cannot be simulated.
    """
    if not fitted.parts:
        return np.inf
    moved = np.array([_change_of_tension(run.recording, rows) for run in fitted.runs for rows in run.rows])
    return sum(
        part.errors.size * float(np.log1p(np.mean(part.errors**2)))
        for part, much in zip(fitted.parts, moved >= np.quantile(moved, 1 - _MOVED), strict=True)
        if much
    )


def _change_of_tension(recording: Recording, rows: slice) -> float:
    """The largest from row to row within a window [N]."""
    values = np.array([recording.pull.at(time) for time in recording.times[rows]])
    return float(np.abs(np.diff(values, axis=0)).max())


def _held(recording: Recording, held: bool) -> Recording:
    if recording.tensions is None:
        return recording
    return replace(recording, tensions=replace(recording.tensions, held=held))
