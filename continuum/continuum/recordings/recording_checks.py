"""Faults of a run's samples, repaired or refused by row."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from continuum.errors import FileError
from continuum.languages import Message
from continuum.recordings.burst_stamps import refuse_bursts
from continuum.recordings.plausible_values import (
    MOST_BAD,
    outliers,
    refuse_mixed_units,
    refuse_units,
    without_still_rates,
)
from continuum.recordings.samples import MESSAGE, Samples
from continuum.recordings.whole_turns import refuse_jumps, unwrapped

_SAME_TIME = 1e-7  # s: no sensor is that fast
_FEWEST_ROWS = 30
_LONGEST_GAP = 0.25  # s; the arm may do anything in a longer one
_UNITS = (("milliseconds", 1e3), ("microseconds", 1e6), ("nanoseconds", np.inf))  # and how many make a second
_LONGEST_HOLD, _HELD = 12, 1 / 3  # most rows that repeat a reading, and fraction of rows above which they are left out
_CLIPPED_ROWS = 3  # consecutive rows with the same extreme value
_CLIPPED_STEP = 3  # units of the last digit, by which a signal jumps to its limit
_ZERO_TENSION = 0.2  # N, largest error of a load cell on a loose cable


def repaired(samples: Samples) -> tuple[Samples, tuple[str, ...]]:
    """Return repaired samples, and a note on each repair.

    Raises:
        FileError: time that runs backward or has gaps or bursts, negative tensions, too many bad rows, or units that
            cannot be the stated ones.
    """
    notes: list[str] = []
    good, held = _without_held(samples)

    def leave_out(bad: NDArray[np.bool_], why: Message) -> Samples:
        if np.any(bad):
            notes.append(Message(why, rows=good.described(bad)))
        return good.chosen(~bad)

    is_message = good.row == MESSAGE
    same_time = (
        Message("{rows} with the time of the message before")
        if is_message
        else Message("{rows} with the time of the row before")
    )
    good = leave_out(~_complete(good), Message("{rows} without a finite value in every column"))
    _refuse_backward(good)
    refuse_bursts(good.chosen(~outliers(good)))
    good = leave_out(np.diff(good.times, prepend=-np.inf) < _SAME_TIME, same_time)
    good = leave_out(_clipped(good), Message("{rows} with a clipped rate"))
    spikes = outliers(good)
    spikes &= ~np.concatenate([[False], spikes[:-1]]) & ~np.concatenate([spikes[1:], [False]])
    refuse_jumps(good.chosen(~spikes))  # one row is a fault of the sensor
    good = leave_out(outliers(good), Message("{rows} with a value that no arm has"))
    if good.times.size < _FEWEST_ROWS:
        summary = "; ".join(["", *notes])
        raise FileError(
            good.path, f"has {good.times.size} usable {good.row}s; at least {_FEWEST_ROWS} are needed{summary}"
        )
    rows = samples.times.size - held
    bad = rows - good.times.size
    if bad > MOST_BAD * rows:
        allowed = f"a tenth may be: {'; '.join(notes)}"
        raise FileError(good.path, f"has {bad} bad {good.row}s of {rows}; at most {allowed}")
    _refuse_gaps(good)
    good, pushing = _without_pushing(good)
    refuse_units(good)
    good, turns = unwrapped(good)
    refuse_mixed_units(good)
    good, unmeasured = without_still_rates(good)
    if held:
        repeats = (
            Message("{count} messages repeat the angles of the message before, as from a slower sensor; left out")
            if is_message
            else Message("{count} rows repeat the angles of the row before, as from a slower sensor; left out")
        )
        pushing.append(Message(repeats, count=held))
    return good, (*(Message("{note}, left out", note=note) for note in notes), *turns, *pushing, *unmeasured)


def _without_held(samples: Samples) -> tuple[Samples, int]:
    """Leave out rows between two readings of a sensor that is slower than the table, and count them.

    In these, all angles are those of the row before, for a few rows at a time; an arm at rest repeats them for longer.
    """
    same = np.all(np.diff(samples.theta, axis=0, prepend=np.nan) == 0, axis=1)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], same, [False]]).astype(int)))
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        same[start:end] &= end - start <= _LONGEST_HOLD
    count = int(np.count_nonzero(same))
    return (samples.chosen(~same), count) if count > _HELD * same.size else (samples, 0)


def _complete(samples: Samples) -> NDArray[np.bool_]:
    """Return the rows in which every number is finite."""
    return np.all(np.isfinite(np.column_stack([samples.times, *samples.measured])), axis=1)


def _refuse_backward(samples: Samples) -> None:
    backward = samples.times[1:] < samples.times[:-1]
    if np.any(backward):
        at = int(np.argmax(backward)) + 1
        where = f"{samples.row} {samples.numbers[at]}"
        raise FileError(
            samples.path, f"{where}: time runs backward, to {samples.times[at]:g} s; are these two recordings?"
        )


def _clipped(samples: Samples) -> NDArray[np.bool_]:
    """Return the rows in which a rate jumps to its extreme and stays there, like a sensor at the end of its range."""
    clipped = np.zeros(samples.times.size, dtype=bool)
    if samples.rate is None:
        return clipped
    for column in samples.rate.T:
        values = np.unique(column)
        if values.size < 3:
            continue  # it never moves
        digit = np.min(np.diff(values))
        for extreme in (values[0], values[-1]):
            if abs(extreme) <= np.max(np.abs(values)) / 2:
                continue
            edges = np.flatnonzero(np.diff(np.concatenate([[False], column == extreme, [False]]).astype(int)))
            for start, end in zip(edges[::2], edges[1::2], strict=True):
                jump = np.abs(column[[max(start - 1, 0), min(end, column.size - 1)]] - extreme)
                if end - start >= _CLIPPED_ROWS and np.max(jump) > _CLIPPED_STEP * digit:
                    clipped[start:end] = True
    return clipped


def _refuse_gaps(samples: Samples) -> None:
    gaps = np.diff(samples.times)
    at = int(np.argmax(gaps))
    if gaps[at] <= _LONGEST_GAP:
        return
    hint = f"; or is the time in {_unit_of(np.median(gaps))}?" if np.median(gaps) > _LONGEST_GAP else ""
    where = f"{samples.row}s {samples.numbers[at]} to {samples.numbers[at + 1]}: a gap of {gaps[at]:.3g} s"
    raise FileError(samples.path, f"{where}; up to {_LONGEST_GAP} s is bridged: split the recording there{hint}")


def _unit_of(step: float) -> str:
    """Return the probable unit of steps from row to row that are too long for seconds."""
    if step == 1:
        return "milliseconds, or a count of rows"
    return next(unit for unit, longest in _UNITS if step <= _LONGEST_GAP * longest)


def _without_pushing(samples: Samples) -> tuple[Samples, list[str]]:
    """Set tensions slightly below zero to zero, and return a note on them."""
    if samples.pull is None or np.all(samples.pull >= 0):
        return samples, []
    least = np.min(samples.pull, axis=1)
    pushes = least < -_ZERO_TENSION
    if np.any(pushes):
        at = int(np.argmax(pushes))
        where = f"{samples.row} {samples.numbers[at]}"
        pushed = (
            f"tension {least[at]:g} N; a cable cannot push, and a load cell's zero is off by {_ZERO_TENSION} N at most"
        )
        raise FileError(samples.path, f"{where}: {pushed}")
    if np.max(samples.pull) <= _ZERO_TENSION:  # as far above as below: noise of load cells on loose cables
        loose = Message(
            "tensions between {low:.2g} and {high:.2g} N indicate slack cables; all were set to zero",
            low=np.min(least), high=np.max(samples.pull),
        )  # fmt: skip
        return replace(samples, pull=np.zeros_like(samples.pull)), [loose]
    note = Message(
        "{rows} with a tension below zero, by {tension:.2g} N at most, set to zero",
        rows=samples.described(least < 0), tension=-np.min(least),
    )  # fmt: skip
    return replace(samples, pull=np.maximum(samples.pull, 0.0)), [note]
