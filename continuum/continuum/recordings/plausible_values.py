"""Whether samples can be from an arm and in the units of their columns."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.languages import Message
from continuum.recordings.motion_columns import ANGLE, RATE, TENSION, TORQUE
from continuum.recordings.samples import Samples

MOST_BAD = 0.1
"""Fraction of all rows that may be bad."""

LARGEST_TURN = 4 * np.pi
"""Largest angle of a joint with a drive [rad]."""

_LARGEST_ANGLE = np.pi  # rad, of a joint between discs
_LEAST_ANGLE = np.deg2rad(1.0)  # that a run must reach; sensors err by tenths of a degree
_LEAST_MOTION = np.deg2rad(1.5)  # of the joint that moves most
_QUIETED = 8  # rows that are averaged for it, against noise
_LARGEST_RATE, _LARGEST_TENSION, _LARGEST_TORQUE = 200.0, 2e3, 2e3  # rad/s, N, N m; no arm of this kind has more
_ALIKE = 0.5  # correlation of a joint's rate with the derivative of its angle above which their sizes are compared


def _limited(samples: Samples) -> list[tuple[Array, float, str]]:
    """Return each measured block with the largest value for an arm of this kind, and the letter of its columns."""
    turn = LARGEST_TURN if samples.turns else _LARGEST_ANGLE
    blocks = (
        (samples.theta, turn, ANGLE.letter),
        (samples.rate, _LARGEST_RATE, RATE.letter),
        (samples.pull, _LARGEST_TENSION, TENSION.letter),
        (samples.torque, _LARGEST_TORQUE, TORQUE.letter),
    )
    return [(block, limit, letter) for block, limit, letter in blocks if block is not None]


def _too_large(value: float, limit: float, letter: str) -> str:
    """Describe a value beyond its limit."""
    if letter == ANGLE.letter:
        wraps = limit < value <= 2 * np.pi
        hint = f"{np.degrees(value):.4g} degrees, where angles wrap at 360, or " if wraps else ""
        return (
            f"joint angle of {value:.3g} rad; no joint turns by more than {limit:.3g}: {hint}degrees taken for radians?"
        )
    return {
        RATE.letter: f"joint rate of {value:.3g} rad/s: degrees taken for radians?",
        TENSION.letter: f"tension of {value:.3g} N; no cable of this kind pulls with more than 2 kN: another unit?",
        TORQUE.letter: f"torque of {value:.3g} N m; no drive of this kind has more than 2 kN m: another unit?",
    }[letter]


def outliers(samples: Samples) -> NDArray[np.bool_]:
    """Return the few rows with a value too large for its unit if all others are far below: error codes, not units."""
    size = np.max([np.max(np.abs(block), axis=1) / limit for block, limit, *_ in _limited(samples)], axis=0)
    large = size > 1
    few = 0 < np.count_nonzero(large) <= MOST_BAD * large.size
    return large if few and np.max(size[~large]) < 1 / 2 else np.zeros_like(large)


def refuse_units(samples: Samples) -> None:
    """Refuse values that are too large or small for their unit.

    Raises:
        FileError: a value is, or the arm hardly moves.
    """
    for block, limit, letter in _limited(samples):
        large = np.abs(block) > limit
        if np.any(large):
            row, column = (int(at[0]) for at in np.nonzero(large))
            where = f"{samples.row} {samples.numbers[row]}, {letter}{column + 1}"
            raise FileError(samples.path, f"{where}: a {_too_large(abs(block[row, column]), limit, letter)}")
    largest = float(np.max(np.abs(samples.theta)))
    if largest < _LEAST_ANGLE:
        raise FileError(
            samples.path,
            f"has no joint angle above {np.degrees(largest):.2g} degrees: radians taken for degrees, or arm at rest?",
        )
    motion = float(np.max(_motion(samples.theta)))
    if motion < _LEAST_MOTION:
        description = (
            f"{np.degrees(motion):.2g} degrees, hardly more than sensors err: at least {np.degrees(_LEAST_MOTION):g}"
        )
        raise FileError(samples.path, f"has joints that move by at most {description} are needed")


def refuse_mixed_units(samples: Samples) -> None:
    """Refuse rates that do not fit their angles, which must be continuous.

    Raises:
        FileError: a rate has another sign or size than the derivative of its angle.
    """
    if samples.rate is not None:
        derivatives = np.gradient(samples.theta, samples.times, axis=0)
        for joint, (slope, rate) in enumerate(zip(derivatives.T, samples.rate.T, strict=True), start=1):
            _refuse_mixed(samples.path, joint, slope, rate)


def without_still_rates(samples: Samples) -> tuple[Samples, list[str]]:
    """Leave out rates that were not measured, which never change although angles do, and return a note on it.

    Raises:
        FileError: only some joints have such rates.
    """
    if samples.rate is None:
        return samples, []
    still = np.ptp(samples.rate, axis=0) == 0
    wrong = still & (_motion(samples.theta) >= _LEAST_MOTION)
    if not np.any(wrong):
        return samples, []
    joint = int(np.argmax(wrong))
    rate = samples.rate[0, joint]
    if not np.all(still):
        description = f"{rate:g} rad/s throughout while its angle changes"
        raise FileError(samples.path, f"joint {joint + 1}: its rate is {description}: was it measured?")
    note = Message(
        "no rate ever changes (joint {joint}: {rate:g} rad/s throughout while its angle changes): rates left out",
        joint=joint + 1, rate=rate,
    )  # fmt: skip
    return replace(samples, rate=None), [note]


def _motion(theta: Array) -> Array:
    """Return the range of each joint's angle, (n_joints,) [rad]."""
    means = [np.mean(piece, axis=0) for piece in np.array_split(theta, max(1, len(theta) // _QUIETED))]
    return np.asarray(np.ptp(means, axis=0))


def _refuse_mixed(path: Path, joint: int, slope: Array, rate: Array) -> None:
    """Refuse a joint whose rate does not have the sign and size of its angle's derivative."""
    alike = 0.0 if np.std(slope) == 0 or np.std(rate) == 0 else np.corrcoef(slope, rate)[0, 1]
    if alike < -_ALIKE:
        raise FileError(path, f"joint {joint}: its rate is negative where its angle grows: one has the wrong sign")
    if alike < _ALIKE:
        return  # too noisy to judge by
    ratio = np.sum(slope * rate) / np.sum(slope**2)
    if not 1 / 15 < ratio < 15:
        raise FileError(
            path,
            f"joint {joint}: its rate is {ratio:.3g} times the change of its angle: degrees and radians mixed?",
        )
