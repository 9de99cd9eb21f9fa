"""The rows of the page, from `rows.toml`: one for each equation, table and figure of the thesis, in its order."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

ROWS = Path(__file__).with_name("rows.toml")


@dataclass(frozen=True)
class Row:
    """One equation, table or figure.

    Attributes:
        number: number in the thesis, "Eq. 9", "Table 3" or "Figure 14".
        what: description.
        names: functions, classes, commands, launch files or other files that implement it.
        tests: tests that cover it, `path::name`.
        reason: reason for missing names or tests; empty if there are both.
    """

    number: str
    what: str
    names: tuple[str, ...] = ()
    tests: tuple[str, ...] = ()
    reason: str = ""

    @property
    def kind(self) -> str:
        """Kind of the row: "Eq.", "Table" or "Figure"."""
        return self.number.partition(" ")[0]


def read_rows(path: Path = ROWS) -> list[Row]:
    """Read all rows of a file."""
    entries = tomllib.loads(path.read_text(encoding="utf-8"))["row"]
    return [Row(**{key: tuple(x) if isinstance(x, list) else x for key, x in entry.items()}) for entry in entries]
