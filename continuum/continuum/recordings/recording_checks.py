"""What may be wrong with samples of a run, repaired or refused by row."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.recordings.motion_columns import ANGLE, RATE, TENSION

_SAME_TIME = 1e-7  # s: no sensor is that fast
_FEWEST_ROWS = 30
_LONGEST_GAP = 0.25  # s; the arm may do anything in a longer one
_MOST_BAD = 0.1  # of all rows
_CLIPPED_ROWS = 3  # of the same extreme value one after the other
_CLIPPED_STEP = 3  # units of the last digit, by which a signal jumps to its limit
_LARGEST_ANGLE = np.pi
_LEAST_ANGLE = np.deg2rad(1.0)  # that a run must reach; sensors err by tenths of a degree
_LEAST_MOTION, _QUIETED = (
    np.deg2rad(1.5),
    8,
)  # of the joint that moves most, noise being quieted by means of so many rows
_ZERO_TENSION = 0.2  # N, by which a load cell may be off where a cable hangs loose
_LARGEST_RATE, _LARGEST_TENSION = 200.0, 2e3  # rad/s, N; no arm of this kind has more
_ALIKE = 0.5  # correlation of a joint's rate with the slope of its angle from which on their sizes are compared


@dataclass(frozen=True)
class Samples:
    """What one run's table holds, NaN where a cell is empty.

    Attributes:
        path: of the file or folder.
        numbers: of the rows in it, as a person counts them, (rows,).
        times: (rows,) [s].
        theta: (rows, n_joints) [rad].
        rate: (rows, n_joints) [rad/s], or None.
        pull: (rows, n_cables) [N], or None.
        row: what a row is called.
    """

    path: Path
    numbers: NDArray[np.int64]
    times: Array
    theta: Array
    rate: Array | None
    pull: Array | None
    row: str = "row"

    def chosen(self, rows: NDArray[np.bool_]) -> Samples:
        """Some of the rows."""
        rate, pull = (None if block is None else block[rows] for block in (self.rate, self.pull))
        return Samples(self.path, self.numbers[rows], self.times[rows], self.theta[rows], rate, pull, self.row)

    def told(self, rows: NDArray[np.bool_]) -> str:
        """`row 7`, or `rows 7, 8, 9, ..`."""
        numbers = [str(number) for number in self.numbers[rows]]
        shown = ", ".join(numbers[:8]) + (", .." if len(numbers) > 8 else "")
        return f"{self.row}{'' if len(numbers) == 1 else 's'} {shown}"


def repaired(samples: Samples) -> tuple[Samples, tuple[str, ...]]:
    """The samples fit for use, and a note on each repair.

    Raises:
        FileError: backward time, long gaps, negative tensions, too many bad rows, or units that cannot be the
            stated ones.
    """
    notes: list[str] = []
    good = samples

    def leave_out(bad: NDArray[np.bool_], why: str) -> Samples:
        if np.any(bad):
            notes.append(f"{good.told(bad)} {why}")
        return good.chosen(~bad)

    good = leave_out(~_complete(good), "without a finite value in every column")
    _refuse_backward(good)
    good = leave_out(np.diff(good.times, prepend=-np.inf) < _SAME_TIME, f"with the time of the {good.row} before")
    good = leave_out(_clipped(good), "with a clipped rate")
    good = leave_out(_outliers(good), "with a value that no arm has")
    if good.times.size < _FEWEST_ROWS:
        told = "; ".join(["", *notes])
        raise FileError(
            good.path, f"has {good.times.size} usable {good.row}s; at least {_FEWEST_ROWS} are needed{told}"
        )
    bad = samples.times.size - good.times.size
    if bad > _MOST_BAD * samples.times.size:
        allowed = f"a tenth may be: {'; '.join(notes)}"
        raise FileError(good.path, f"has {bad} bad {good.row}s of {samples.times.size}; at most {allowed}")
    _refuse_gaps(good)
    good, pushing = _without_pushing(good)
    _refuse_units(good)
    return good, (*(f"{note}, left out" for note in notes), *pushing)


def _complete(samples: Samples) -> NDArray[np.bool_]:
    """Rows in which every number is finite."""
    blocks = [block for block in (samples.theta, samples.rate, samples.pull) if block is not None]
    return np.all(np.isfinite(np.column_stack([samples.times, *blocks])), axis=1)


def _limited(samples: Samples) -> list[tuple[Array, float, str, str]]:
    """What was measured, the most that an arm of this kind has, what is told of more, and the letter of its columns."""
    blocks = (
        (
            samples.theta,
            _LARGEST_ANGLE,
            "joint angle of {:.3g} rad; no joint turns by more than 3.14: degrees taken for radians?",
            ANGLE.letter,
        ),
        (samples.rate, _LARGEST_RATE, "joint rate of {:.3g} rad/s: degrees taken for radians?", RATE.letter),
        (
            samples.pull,
            _LARGEST_TENSION,
            "tension of {:.3g} N; no cable of this kind pulls with more than 2 kN: another unit?",
            TENSION.letter,
        ),
    )
    return [(block, limit, what, letter) for block, limit, what, letter in blocks if block is not None]


def _outliers(samples: Samples) -> NDArray[np.bool_]:
    """Few rows with a value too large for its unit, where all others are far from that: an error code, no unit."""
    size = np.max([np.max(np.abs(block), axis=1) / limit for block, limit, *_ in _limited(samples)], axis=0)
    large = size > 1
    few = 0 < np.count_nonzero(large) <= _MOST_BAD * large.size
    return large if few and np.max(size[~large]) < 1 / 2 else np.zeros_like(large)


def _refuse_backward(samples: Samples) -> None:
    backward = samples.times[1:] < samples.times[:-1]
    if np.any(backward):
        at = int(np.argmax(backward)) + 1
        where = f"{samples.row} {samples.numbers[at]}"
        raise FileError(
            samples.path, f"{where}: time runs backward, to {samples.times[at]:g} s; are these two recordings?"
        )


def _clipped(samples: Samples) -> NDArray[np.bool_]:
    """Rows in which a rate stands still at its extreme and jumps there, as a sensor at the end of its range does."""
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
                beside = np.abs(column[[max(start - 1, 0), min(end, column.size - 1)]] - extreme)
                if end - start >= _CLIPPED_ROWS and np.max(beside) > _CLIPPED_STEP * digit:
                    clipped[start:end] = True
    return clipped


def _refuse_gaps(samples: Samples) -> None:
    gaps = np.diff(samples.times)
    at = int(np.argmax(gaps))
    if gaps[at] <= _LONGEST_GAP:
        return
    hint = "; or is the time in milliseconds?" if np.median(gaps) > _LONGEST_GAP else ""
    where = f"{samples.row}s {samples.numbers[at]} to {samples.numbers[at + 1]}: a gap of {gaps[at]:.3g} s"
    raise FileError(samples.path, f"{where}; up to {_LONGEST_GAP} s is bridged: split the recording there{hint}")


def _without_pushing(samples: Samples) -> tuple[Samples, list[str]]:
    """Tensions a little below zero taken as none, and a note on them."""
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
    if np.max(samples.pull) <= _ZERO_TENSION:  # as far above as below: noise of cells whose cables hang loose
        told = f"tensions from {np.min(least):.2g} to {np.max(samples.pull):.2g} N are of cables that hang loose"
        return replace(samples, pull=np.zeros_like(samples.pull)), [f"{told}, all taken as none"]
    note = f"{samples.told(least < 0)} with a tension below zero, by {-np.min(least):.2g} N at most, taken as none"
    return replace(samples, pull=np.maximum(samples.pull, 0.0)), [note]


def _refuse_units(samples: Samples) -> None:
    """Refuse what is too large or small for its unit."""
    for block, limit, what, letter in _limited(samples):
        large = np.abs(block) > limit
        if np.any(large):
            row, column = (int(at[0]) for at in np.nonzero(large))
            where = f"{samples.row} {samples.numbers[row]}, {letter}{column + 1}"
            raise FileError(samples.path, f"{where}: a " + what.format(abs(block[row, column])))
    largest = float(np.max(np.abs(samples.theta)))
    if largest < _LEAST_ANGLE:
        raise FileError(
            samples.path,
            f"has no joint angle above {np.degrees(largest):.2g} degrees: radians taken for degrees, or arm at rest?",
        )
    motion = _largest_motion(samples.theta)
    if motion < _LEAST_MOTION:
        told = f"{np.degrees(motion):.2g} degrees, hardly more than sensors err: at least {np.degrees(_LEAST_MOTION):g}"
        raise FileError(samples.path, f"is of an arm whose joints move by at most {told} are needed")
    if samples.rate is not None:
        slopes = np.gradient(samples.theta, samples.times, axis=0)
        for joint, (slope, rate) in enumerate(zip(slopes.T, samples.rate.T, strict=True), start=1):
            _refuse_mixed(samples.path, joint, slope, rate)


def _largest_motion(theta: Array) -> float:
    """From the least to the most of the joint that moves most [rad]."""
    means = [np.mean(piece, axis=0) for piece in np.array_split(theta, max(1, len(theta) // _QUIETED))]
    return float(np.max(np.ptp(means, axis=0)))


def _refuse_mixed(path: Path, joint: int, slope: Array, rate: Array) -> None:
    """Refuse a joint whose rate is not of the sign and size of its angle's slope."""
    alike = 0.0 if np.std(slope) == 0 or np.std(rate) == 0 else np.corrcoef(slope, rate)[0, 1]
    if alike < -_ALIKE:
        raise FileError(path, f"joint {joint}: its rate is negative where its angle grows: one has the other sign")
    if alike < _ALIKE:
        return  # too noisy to judge by
    ratio = np.sum(slope * rate) / np.sum(slope**2)
    if not 1 / 15 < ratio < 15:
        raise FileError(
            path,
            f"joint {joint}: rates {ratio:.3g} times as large as its angle changes: degrees and radians mixed?",
        )
