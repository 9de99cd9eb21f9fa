"""Results of the parts as files, so that the record can summarise several runs."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from continuum.whole_file import write_whole
from tools.benchmarks.link.campaign import Case
from tools.benchmarks.link.closed_loop import ClosedLoop, Minute
from tools.benchmarks.link.crash_tests import Crash
from tools.benchmarks.link.soak import Memory, Soak
from tools.benchmarks.link.starvation import Starved


@dataclass(frozen=True)
class Results:
    """Available results, None for parts without a run, and the niceness of the processes by part.

    All runs of the closed loop are kept, the newest last, because delays depend on other load of the machine.
    """

    closed: list[ClosedLoop] | None
    campaign: list[Case] | None
    crash_tests: list[Crash] | None
    starvation: list[Starved] | None
    soak: Soak | None
    niceness: dict[str, int] = field(default_factory=dict)


PARTS = "closed", "campaign", "crash_tests", "starvation", "soak"
"""Parts, each stored in a file of its name."""


def keep(folder: Path, part: str, result: Any, niceness: int) -> None:
    """Write the results of a part."""
    plain = [asdict(one) for one in result] if isinstance(result, Sequence) else asdict(result)
    text = json.dumps({"niceness": niceness, "result": plain}, indent=1)
    write_whole(folder / f"{part}.json", f"{text}\n")


def together(kept: Sequence[Case] | None, new: Sequence[Case]) -> list[Case]:
    """Merge stored cases with new ones, which replace those with the same faults."""
    cases = {tuple(case.faults): case for case in (*(kept or []), *new)}
    return list(cases.values())


def load(folder: Path) -> Results:
    """Load all stored results."""
    kept = {part: _plain(folder / f"{part}.json") for part in PARTS}
    closed, campaign, crash_tests, starvation, soak = (kept[part] and kept[part]["result"] for part in PARTS)
    for run in closed or []:
        run["by_minute"] = [Minute(**minute) for minute in run["by_minute"]]
    if soak:
        soak |= {name: Memory(**soak[name]) for name in ("bridge", "emulator")}
    return Results(
        closed and [ClosedLoop(**run) for run in closed],
        campaign and [Case(**case) for case in campaign],
        crash_tests and [Crash(**crash) for crash in crash_tests],
        starvation and [Starved(**way) for way in starvation],
        soak and Soak(**soak),
        {part: known["niceness"] for part, known in kept.items() if known},
    )


def _plain(file: Path) -> Any:
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else None
