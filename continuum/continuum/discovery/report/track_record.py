"""How often verdicts were right on simulated arms whose faults are known."""

from __future__ import annotations

import json
from importlib import resources
from typing import NamedTuple

from continuum.discovery.decision import Kind


class Record(NamedTuple):
    """Track record of one kind of verdict.

    Attributes:
        n: number of verdicts of this kind.
        right: number of these that were right.
        low, high: 95 % Wilson interval of the fraction that is right, 0 to 1.
    """

    n: int
    right: int
    low: float
    high: float


def track_record(kind: Kind) -> Record | None:
    """Read the record of a kind from track_record.json, which `make bench-discovery` writes; None if it never occurred.

    `cause` is right if all that it names was hidden, `ambiguous` if one of its sets was exactly what was hidden,
    `adequate` if nothing was, `unknown` if an effect outside of the library was.
    """
    text = resources.files(__package__).joinpath("track_record.json").read_text(encoding="utf-8")
    found = json.loads(text)["verdicts"][kind.value]
    return Record(found["n"], found["right"], found["low"], found["high"]) if found["n"] else None
