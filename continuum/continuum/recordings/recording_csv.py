"""Recordings from CSV: `t_s`, `q1_deg` or `q1_rad` .., optional `dq1_deg_s` or `dq1_rad_s` .., and what drives the arm.

That is `u1_N`, `u2_N`, the tensions of two cables of which cable 1 bends the arm towards positive angles, or `tau1_Nm`
.., the torques of drives at the joints, positive towards positive angles. Damage is repaired, with a note, if that
invents no data; otherwise the file is refused, and the message names the row (the header is row 1).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.tensions import Tensions
from continuum.errors import FileError
from continuum.languages import Message
from continuum.printable import printable
from continuum.recordings.csv_layout import hint_of_cell, number_of
from continuum.recordings.motion_columns import ANGLE, QUANTITIES, RATE, TENSION, TIME, TORQUE, Quantity
from continuum.recordings.recording import Recording
from continuum.recordings.recording_checks import repaired
from continuum.recordings.samples import Samples
from continuum.recordings.table_file import read_table

_NAMES = f"{TIME} [s], q1_deg .. or q1_rad .., and optionally dq1_deg_s .., u1_N, u2_N or tau1_Nm .."


def read_recording_csv(path: str | Path, model: Model | None = None) -> Recording:
    """Read one run, named after the file without its suffix; a model says whether joints without torques turn round.

    Raises:
        FileError: the file cannot be read, has other columns, or is damaged beyond repair.
    """
    path = Path(path)
    header, numbers, table = _numbers(path)
    columns = {name: table[:, i] for i, name in enumerate(header)}
    theta, others = _block(path, columns, ANGLE), _of_nothing(header)
    if theta is None:
        raise FileError(path, f"has no joint angles q1_deg .. or q1_rad ..; it has {', '.join(header)}")
    rate, pull, torque = (_block(path, columns, quantity) for quantity in (RATE, TENSION, TORQUE))
    if rate is not None and rate.shape != theta.shape:
        raise FileError(path, f"has {theta.shape[1]} joint angles but {rate.shape[1]} joint rates")
    if pull is not None and pull.shape[1] != 2:
        raise FileError(path, f"has tensions of {pull.shape[1]} cables; a planar section has u1_N and u2_N")
    if torque is not None and torque.shape != theta.shape:
        raise FileError(path, f"has {theta.shape[1]} joint angles but {torque.shape[1]} joint torques")
    if torque is not None and pull is not None:
        raise FileError(path, "has tensions, u1_N .., and torques, tau1_Nm ..: one or the other drives an arm")
    turns = torque is not None or (model is not None and model.inputs is InputKind.JOINT_TORQUES)
    good, notes = repaired(Samples(path, numbers, columns[TIME], theta, rate, pull, torque=torque, turns=turns))
    tensions = None if good.pull is None else Tensions(good.times, good.pull)
    torques = None if good.torque is None else JointTorques(good.times, good.torque)
    for quantity in QUANTITIES:
        if any(name and name[0] == 0 for name in map(quantity.names, header)):
            text = Message("{letter}0 is read as number 1: numbers count from 0 in this file")
            notes = (*notes, Message(text, letter=quantity.letter))
    if others:
        named = ", ".join(name or "one without a name" for name in others)
        notes = (*notes, Message("unknown columns, not used: {names}", names=named))
    return Recording(printable(path.stem), good.times, good.theta, good.rate, tensions, notes, torques)


def _of_nothing(header: Sequence[str]) -> list[str]:
    """Return the columns that are neither the time nor of a quantity."""
    return [name for name in header if name != TIME and not any(q.names(name) for q in QUANTITIES)]


def _numbers(path: Path) -> tuple[list[str], NDArray[np.int64], Array]:
    """Read the header, the numbers of the rows that are not blank, and their values, (rows, columns).

    A cell without a value is NaN, and so is any cell of an unknown column, such as a remark.
    """
    found = read_table(path, TIME, _NAMES)
    header = found.header
    for name in header:
        if name and header.count(name) > 1:
            raise FileError(path, f"has the column {name!r} twice")
    table, others = np.full((len(found.rows), len(header)), np.nan), _of_nothing(header)
    for row, number, values in zip(table, found.numbers, found.rows, strict=True):
        for i, (column, value) in enumerate(zip(header, values, strict=True)):
            row[i] = np.nan if column in others else _number(path, number, column, value)
    return header, found.numbers, table


def _number(path: Path, row: int, column: str, cell: str) -> float:
    try:
        return number_of(cell)
    except ValueError as error:
        raise FileError(path, f"row {row}, column {column}: {cell!r} is not a number{hint_of_cell(cell)}") from error


def _block(path: Path, columns: dict[str, Array], quantity: Quantity) -> Array | None:
    """Return all columns of a quantity in SI units, (rows, n); None if there are none."""
    found: dict[int, Array] = {}
    for name, values in columns.items():
        named = quantity.names(name)
        if named is None:
            continue
        number, unit = named
        if unit not in quantity.units:
            allowed = ", ".join(quantity.units)
            raise FileError(path, f"has the column {name}; allowed units of {quantity.letter}: {allowed}")
        if number in found:
            raise FileError(path, f"has {quantity.letter}{number} twice, in two units")
        found[number] = values * quantity.units[unit]
    if not found:
        return None
    if 0 in found:  # another program counts from 0
        found = {number + 1: values for number, values in found.items()}
    if sorted(found) != list(range(1, len(found) + 1)):
        numbers, others = ", ".join(map(str, sorted(found))), ", ".join(_of_nothing(list(columns)))
        hint = f"; unknown: {others}" if others else ""
        raise FileError(path, f"has {quantity.letter} of {numbers}: numbers must run from 1 without a gap{hint}")
    return np.stack([found[number] for number in sorted(found)], axis=1)
