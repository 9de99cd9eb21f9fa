"""Angles that are logged within one turn and jump to its other end, as from 3.13 to -3.14 rad.

A step from row to row jumps by a whole turn if the rest of it is a motion of the joint: at most twice as fast as its
fastest step that is not beside a jump, since a joint hardly changes its speed from one row to the next. Any other step
by more than half a turn is a fault of the sensor; the step back from it is beside it.

The same pose may be logged as 350 or as -10 degrees. In every recording a joint that can turn round begins within half
a turn of zero, whether the log jumps or not, so that recordings of one arm have the same angles for the same pose.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.languages import Message
from continuum.recordings.motion_columns import ANGLE
from continuum.recordings.samples import Samples

_FASTER = 2.0
_BEYOND = 0.02  # rad by which noise, or a wrap to the nearest tick, takes a logged angle past the end of its turn


def refuse_jumps(samples: Samples) -> None:
    """Refuse whole turns of joints that cannot turn round.

    Raises:
        FileError: there is one.
    """
    jumps, _ = _jumps(samples)
    if samples.turns or not np.any(jumps):
        return
    row, joint = _first(jumps)
    end = 360 if np.max(samples.theta[row - 1 : row + 1, joint]) > 1.5 * np.pi else 180
    question = f"does the log wrap at {end} degrees? Write continuous angles; only those of joints with drives, in a "
    question += "model of joint torques or beside columns tau1_Nm .., are unwrapped here"
    raise FileError(samples.path, f"{_step(samples, row, joint)}: {question}")


def unwrapped(samples: Samples) -> tuple[Samples, list[Message]]:
    """Return angles without jumps, which begin within half a turn of zero, and a note on each joint that changed.

    Raises:
        FileError: a joint steps by more than half a turn, and not by a whole one.
    """
    jumps, faults = _jumps(samples)
    if np.any(faults):
        question = "does the sensor fail there, or does the log wrap at less than a turn?"
        raise FileError(samples.path, f"{_step(samples, *_first(faults))}, as fast as no other step: {question}")
    begin = np.round(samples.theta[0] / (2 * np.pi)) if samples.turns else np.zeros(samples.theta.shape[1])
    if not np.any(jumps) and not np.any(begin):
        return samples, []
    theta = samples.theta - 2 * np.pi * begin
    theta[1:] -= 2 * np.pi * np.cumsum(jumps, axis=0)
    notes = []
    for joint in np.flatnonzero(np.any(jumps, axis=0)):
        after = np.concatenate([[False], jumps[:, joint] != 0])
        row = int(np.argmax(after))
        first, then = np.degrees(samples.theta[row - 1 : row + 1, joint])
        note = Message(
            "{rows}: {letter}{joint} jumps by a whole turn, as from {first:.1f} to {then:.1f} degrees; unwrapped",
            rows=samples.described(after), letter=ANGLE.letter, joint=joint + 1, first=first, then=then,
        )  # fmt: skip
        notes.append(note)
    for joint in np.flatnonzero(begin):
        first, then = np.degrees([samples.theta[0, joint], theta[0, joint]])
        note = Message(
            "{letter}{joint} begins at {first:.1f} degrees, taken for {then:.1f}: within half a turn of zero",
            letter=ANGLE.letter, joint=joint + 1, first=first, then=then,
        )  # fmt: skip
        notes.append(note)
    return replace(samples, theta=theta), notes


def _jumps(samples: Samples) -> tuple[Array, NDArray[np.bool_]]:
    """Return the turns by which each step jumps, (rows - 1, n_joints), and the steps that are faults."""
    steps = np.diff(samples.theta, axis=0)
    turns = np.round(steps / (2 * np.pi))
    if not np.any(turns):
        return turns, np.zeros(turns.shape, dtype=bool)
    took = np.diff(samples.times)[:, None]
    rates = np.abs(steps - 2 * np.pi * turns) / np.maximum(took, np.median(took))  # jitter alone makes none fast
    moves = np.pad(turns == 0, ((1, 1), (0, 0)), constant_values=True)
    fastest = np.max(np.where(moves[:-2] & moves[1:-1] & moves[2:], rates, 0.0), axis=0)
    within_a_turn = np.ptp(samples.theta, axis=0) <= 2 * (np.pi + _BEYOND)
    whole = (np.abs(turns) == 1) & (rates <= _FASTER * fastest) & within_a_turn
    return np.where(whole, turns, 0), (turns != 0) & ~whole


def _first(steps: NDArray[np.generic]) -> tuple[int, int]:
    """Return the row after the first of some steps, and the joint."""
    row, joint = (int(at[0]) for at in np.nonzero(steps))
    return row + 1, joint


def _step(samples: Samples, row: int, joint: int) -> str:
    """Describe the step to a row of the samples."""
    first, then = samples.theta[row - 1 : row + 1, joint]
    took = samples.times[row] - samples.times[row - 1]
    where = f"{samples.row} {samples.numbers[row]}, {ANGLE.letter}{joint + 1}"
    degrees = f"{np.degrees(first):.4g} to {np.degrees(then):.4g} degrees"
    return f"{where}: from {first:.3g} to {then:.3g} rad ({degrees}) in {1e3 * took:.3g} ms"
