"""The record of a benchmark: its figures with goals and rivals, its tables, and the place and time of the measurement.

Each record is stored in ``docs/benchmarks/NAME.json``, with one line per figure and per table row.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from decimal import Decimal
from pathlib import Path
from typing import Any

import msgspec

from continuum.errors import FileError, InvalidValueError
from continuum.whole_file import write_whole
from tools.benchmarks.surroundings import machine, today

_DIGITS = 3
"""Significant digits of a printed value; more if rounding would print a missed goal as met."""


@dataclass(frozen=True)
class Figure:
    """One figure.

    Attributes:
        what: description of the measured quantity.
        value: measured value in the unit, like the bounds, the interval and the rival's value.
        unit: "s", "%" and so on; empty for a count or a ratio.
        at_least, at_most: the goal; None for no bound.
        rival, rival_value: another method, and its value in the same run.
        interval: 95 % interval.
        n: number of cases of a rate or a quantile.

    Raises:
        InvalidValueError: the figure has no name, a value is not finite, or only one of rival and its value is given.
    """

    what: str
    value: float
    unit: str = ""
    at_least: float | None = None
    at_most: float | None = None
    rival: str = ""
    rival_value: float | None = None
    interval: tuple[float, float] | None = None
    n: int | None = None

    def __post_init__(self) -> None:
        if not self.what:
            raise InvalidValueError("what", self.what, "words")
        for number in (self.value, self.at_least, self.at_most, self.rival_value, *(self.interval or ())):
            if number is not None and not math.isfinite(number):
                raise InvalidValueError(self.what, number, "a finite number")
        if bool(self.rival) != (self.rival_value is not None):
            raise InvalidValueError(f"{self.what}: rival", self.rival, "a name with a value, or neither")

    @property
    def is_met(self) -> bool | None:
        """Whether the goal is met; None without a goal."""
        return None if self.at_least is self.at_most is None else self._meets(self.value)

    @property
    def printed(self) -> str:
        """Value with interval and unit, rounded so that it stays on its side of the goal."""
        texts = (plain(self.value, digits) for digits in range(_DIGITS, 18))
        text = next((one for one in texts if self._meets(float(one)) == self._meets(self.value)), repr(self.value))
        interval = "" if self.interval is None else " ({} to {})".format(*map(plain, self.interval))
        cases = "" if self.n is None else f", n {self.n}"
        return f"{text}{self._unit}{interval}{cases}"

    @property
    def goal(self) -> str:
        """Text of the goal; empty without one."""
        if self.at_least is not None and self.at_most is not None:
            return f"{plain(self.at_least, 4)} to {plain(self.at_most, 4)}{self._unit}"
        if self.at_least is not None:
            return f">= {plain(self.at_least, 4)}{self._unit}"
        return "" if self.at_most is None else f"<= {plain(self.at_most, 4)}{self._unit}"

    @property
    def rival_printed(self) -> str:
        """Text with name and value of the rival; empty without one."""
        return "" if self.rival_value is None else f"{self.rival}: {plain(self.rival_value)}{self._unit}"

    @property
    def _unit(self) -> str:
        return f" {self.unit}" if self.unit else ""

    def _meets(self, value: float) -> bool:
        low = -math.inf if self.at_least is None else self.at_least
        high = math.inf if self.at_most is None else self.at_most
        return low <= value <= high


@dataclass(frozen=True)
class Table:
    """Results that are too extensive for figures: cells as printed."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    @classmethod
    def of(cls, head: Sequence[object], rows: Iterable[Iterable[object]]) -> Table:
        """Create a table from cells of any type."""
        return cls(tuple(map(str, head)), tuple(tuple(map(str, row)) for row in rows))


@dataclass(frozen=True)
class Record:
    """One run of one command.

    Attributes:
        name: name of its file.
        command: command that measured it, `make TARGET` or `python3 -m MODULE`.
        figures: figures, the most important first.
        tables: tables by name, for pages and for details beyond the figures.
        notes: further facts about this run, in complete sentences.
        date, machine: time and place of the measurement; empty if unknown.
    """

    name: str
    command: str
    figures: tuple[Figure, ...]
    tables: Mapping[str, Table] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    date: str = field(default_factory=today)
    machine: str = field(default_factory=machine)


def write(record: Record, folder: Path) -> Path:
    """Write a record to the file of its name, and return the file.

    Raises:
        FileError: the file cannot be written.
    """
    path = folder / f"{record.name}.json"
    folder.mkdir(parents=True, exist_ok=True)
    write_whole(path, "".join(_lines(record)))
    return path


def read(folder: Path) -> list[Record]:
    """Read all records of a folder, sorted by name.

    Raises:
        FileError: a file is not a record.
    """
    found = []
    for path in sorted(folder.glob("*.json")):
        try:
            found.append(msgspec.json.decode(path.read_bytes(), type=Record))
        except msgspec.MsgspecError as error:
            raise FileError(path, f"is no record of a benchmark ({error})") from error
    return found


def plain(number: float, digits: int = _DIGITS) -> str:
    """Return a number with the given significant digits and without an exponent; integers are complete."""
    if float(number).is_integer():
        return f"{number:.0f}"
    return f"{Decimal(f'{number:.{digits}g}'):f}"


def _lines(record: Record) -> Iterator[str]:
    known = asdict(record)
    figures, tables = map(_said, known.pop("figures")), known.pop("tables")
    yield "{\n"
    for key, value in known.items():
        yield f" {_json(key)}: {_json(value)},\n"
    yield f' "figures": {_listed([*figures], 1)},\n "tables": {{'
    for number, (name, one) in enumerate(tables.items()):
        yield f'{"," * bool(number)}\n  {_json(name)}: {{\n   "head": {_json(one["head"])},\n'
        yield f'   "rows": {_listed(one["rows"], 3)}\n  }}'
    yield f"{chr(10) + ' ' if tables else ''}}}\n}}\n"


def _said(figure: dict[str, Any]) -> dict[str, Any]:
    """Return the non-empty entries of a figure."""
    return {key: value for key, value in figure.items() if value not in (None, "")}


def _listed(items: Sequence[Any], depth: int) -> str:
    """Return a JSON list with one item per line."""
    if not items:
        return "[]"
    inside = f"\n{' ' * (depth + 1)}"
    return f"[{inside}{f',{inside}'.join(map(_json, items))}\n{' ' * depth}]"


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)
