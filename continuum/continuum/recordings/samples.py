"""The contents of one run's table, before they are checked."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.languages import Message

MESSAGE: Final = "message"
"""Word for a row of a recording of messages."""


@dataclass(frozen=True)
class Samples:
    """Rows of a table, NaN where a cell is empty.

    Attributes:
        path: path of the file or folder.
        numbers: numbers of the rows in it, from 1, (rows,).
        times: (rows,) [s].
        theta: (rows, n_joints) [rad].
        rate: (rows, n_joints) [rad/s], or None.
        pull: (rows, n_cables) [N], or None.
        row: word for a row in messages.
        torque: (rows, n_joints) [N m], or None.
        turns: whether a joint may turn by more than half a turn, as those with drives do.
    """

    path: Path
    numbers: NDArray[np.int64]
    times: Array
    theta: Array
    rate: Array | None
    pull: Array | None
    row: str = "row"
    torque: Array | None = None
    turns: bool = False

    @property
    def measured(self) -> list[Array]:
        """All blocks that are not None, (rows, columns) each."""
        blocks = (self.theta, self.rate, self.pull, self.torque)
        return [block for block in blocks if block is not None]

    def chosen(self, rows: NDArray[np.bool_]) -> Samples:
        """Return some of the rows."""
        some = (None if block is None else block[rows] for block in (self.rate, self.pull, self.torque))
        rate, pull, torque = some
        return replace(
            self,
            numbers=self.numbers[rows],
            times=self.times[rows],
            theta=self.theta[rows],
            rate=rate,
            pull=pull,
            torque=torque,
        )

    def described(self, rows: NDArray[np.bool_]) -> Message:
        """Format as `row 7`, or `rows 7, 8, 9, ..`."""
        numbers = [str(number) for number in self.numbers[rows]]
        shown = ", ".join(numbers[:8]) + (", .." if len(numbers) > 8 else "")
        if self.row == MESSAGE:
            one, several = Message("message {numbers}"), Message("messages {numbers}")
        else:
            one, several = Message("row {numbers}"), Message("rows {numbers}")
        return Message(one if len(numbers) == 1 else several, numbers=shown)
