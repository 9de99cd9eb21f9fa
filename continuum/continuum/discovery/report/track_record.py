"""How often verdicts were right on simulated arms whose faults are known."""

from __future__ import annotations

import json
from importlib import resources
from typing import NamedTuple

from continuum.discovery.decision import Kind


class Record(NamedTuple):
    """Of a kind of verdict.

    Attributes:
        n: verdicts of this kind.
        right: of them.
        low, high: Wilson interval of 95 % of the part that is right, 0 to 1.
    """

    n: int
    right: int
    low: float
    high: float


def track_record(kind: Kind) -> Record | None:
    """Of one kind, from track_record.json, which `make bench-discovery` writes; None where there was no such verdict.

    `cause` is right where all that it names was hidden, `ambiguous` where one of its sets was exactly what was hidden,
    `adequate` where nothing was, `unknown` where an effect outside of the library was.
    """
    text = resources.files(__package__).joinpath("track_record.json").read_text(encoding="utf-8")
    found = json.loads(text)["verdicts"][kind.value]
    return Record(found["n"], found["right"], found["low"], found["high"]) if found["n"] else None
