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
        number: as the thesis numbers it, "Eq. 9", "Table 3" or "Figure 14".
        what: what it is.
        names: functions, classes, commands, launch files or other files that are its counterpart here.
        tests: tests that cover it, `path::name`.
        reason: why there are no names, or no tests; empty where there are both.
    """

    number: str
    what: str
    names: tuple[str, ...] = ()
    tests: tuple[str, ...] = ()
    reason: str = ""

    @property
    def kind(self) -> str:
        """Its number without the number: "Eq.", "Table" or "Figure"."""
        return self.number.partition(" ")[0]


def read_rows(path: Path = ROWS) -> list[Row]:
    """All rows of a table."""
    entries = tomllib.loads(path.read_text(encoding="utf-8"))["row"]
    return [Row(**{key: tuple(x) if isinstance(x, list) else x for key, x in entry.items()}) for entry in entries]
