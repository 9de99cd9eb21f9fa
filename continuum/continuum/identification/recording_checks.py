"""What may be wrong with a table of samples, repaired or refused by row; rows count from the header as row 1."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.errors import FileError

_FEWEST_ROWS = 30
_LONGEST_GAP = 0.25  # s; the arm may do anything in a longer one
_MOST_BAD = 0.1  # of all rows
_CLIPPED_ROWS = 3  # of the same extreme value one after the other


@dataclass(frozen=True)
class GoodRows:
    """Rows that are fit for use, (n_rows,) of bool, and a note on each repair."""

    rows: NDArray[np.bool_]
    notes: tuple[str, ...]


def checked(path: Path, times: Array, theta: Array, rate: Array | None, pull: Array | None) -> GoodRows:
    """The rows to use.

    Args:
        times: (rows,) [s].
        theta, rate: (rows, n_joints) [rad, rad/s].
        pull: (rows, n_cables) [N].

    Raises:
        FileError: backward time, long gaps, negative tensions, too many bad rows, or units that cannot be the
        stated ones.
    """
    blocks = [times[:, None], theta, *(block for block in (rate, pull) if block is not None)]
    missing = ~np.all(np.isfinite(np.concatenate(blocks, axis=1)), axis=1)
    notes = [*_told(missing, "without a finite value in every column, left out")]
    keep = ~missing
    keep &= ~_repeated(path, times, keep, notes)
    if rate is not None:
        clipped = keep & _clipped(rate)
        notes += _told(clipped, "with a clipped rate, left out")
        keep &= ~clipped
    if keep.sum() < _FEWEST_ROWS:
        raise FileError(path, f"has {keep.sum()} usable rows; at least {_FEWEST_ROWS} are needed")
    if (~keep).sum() > _MOST_BAD * keep.size:
        raise FileError(path, f"has {(~keep).sum()} bad rows of {keep.size}: " + "; ".join(notes))
    _refuse_gaps(path, times, keep)
    if pull is not None and np.any(pull[keep] < 0):
        row = np.flatnonzero(keep)[np.argmax(np.any(pull[keep] < 0, axis=1))]
        raise FileError(path, f"{_rows([row])}: tension {pull[row].min():g} N; a cable cannot push")
    _refuse_units(path, times[keep], theta[keep], None if rate is None else rate[keep])
    return GoodRows(keep, tuple(notes))


def _repeated(path: Path, times: Array, keep: NDArray[np.bool_], notes: list[str]) -> NDArray[np.bool_]:
    """Rows whose time is that of the row before; the first is kept."""
    index = np.flatnonzero(keep)
    step = np.diff(times[index])
    if np.any(step < 0):
        at = index[1:][np.argmax(step < 0)]
        raise FileError(path, f"{_rows([at])}: time runs backward, to {times[at]:g} s; are these two recordings?")
    repeated = np.zeros(keep.size, dtype=bool)
    repeated[index[1:][step == 0]] = True
    notes += _told(repeated, "with the time of the row before, left out")
    return repeated


def _clipped(rate: Array) -> NDArray[np.bool_]:
    """Rows in which a rate stands still at its extreme, as a sensor at the end of its range does."""
    clipped = np.zeros(rate.shape[0], dtype=bool)
    for column in rate.T:
        for extreme in (np.nanmax(column), np.nanmin(column)):
            at = np.abs(column) > 0
            at &= column == extreme
            runs = np.flatnonzero(np.diff(np.concatenate([[False], at, [False]]).astype(int)))
            for start, end in zip(runs[::2], runs[1::2], strict=True):
                if end - start >= _CLIPPED_ROWS and abs(extreme) > 0.5 * np.nanmax(np.abs(column)):
                    clipped[start:end] = True
    return clipped


def _refuse_gaps(path: Path, times: Array, keep: NDArray[np.bool_]) -> None:
    index = np.flatnonzero(keep)
    gaps = np.diff(times[index])
    if np.max(gaps) > _LONGEST_GAP:
        at = int(np.argmax(gaps))
        hint = "; or is the time in milliseconds?" if np.median(gaps) > _LONGEST_GAP else ""
        where = f"rows {index[at] + 2} to {index[at + 1] + 2}: a gap of {gaps[at]:.3g} s"
        raise FileError(path, f"{where}; up to {_LONGEST_GAP} s is bridged: split the file there{hint}")


def _refuse_units(path: Path, times: Array, theta: Array, rate: Array | None) -> None:
    if np.max(np.abs(theta)) > 2 * np.pi:
        raise FileError(path, f"has a joint angle of {np.max(np.abs(theta)):.3g} rad: degrees under a column _rad?")
    if rate is None:
        return
    from_angles, both = np.gradient(theta, times, axis=0), np.std(rate)
    if both == 0 or np.std(from_angles) == 0 or np.corrcoef(from_angles.ravel(), rate.ravel())[0, 1] < 0.5:
        return  # too noisy to judge by
    ratio = np.sum(from_angles * rate) / np.sum(from_angles**2)
    if ratio > 15 or ratio < 1 / 15:
        raise FileError(path, f"has rates {ratio:.3g} times as large as its angles change: degrees and radians mixed?")


def _told(rows: NDArray[np.bool_], what: str) -> list[str]:
    return [f"{_rows(np.flatnonzero(rows))} {what}"] if np.any(rows) else []


def _rows(index: object) -> str:
    """`row 7`, or `rows 7, 8, 9, ..` of the file."""
    numbers = [str(int(i) + 2) for i in np.atleast_1d(np.asarray(index))]
    return ("row " if len(numbers) == 1 else "rows ") + ", ".join(numbers[:8]) + (", .." if len(numbers) > 8 else "")
