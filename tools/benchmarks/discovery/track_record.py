"""Rate at which verdicts of each kind were right, for the page of a diagnosis."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from continuum.whole_file import write_whole
from tools.benchmarks.discovery.answer import Answer, answer
from tools.benchmarks.discovery.figures import Rate
from tools.benchmarks.discovery.plans import HALVES
from tools.benchmarks.discovery.result import Result

KINDS: Final = ("adequate", "cause", "ambiguous", "unknown")


def track_record(results: Sequence[Result]) -> dict[str, Any]:
    """Return for each kind of verdict the number of cases, the number of right ones, and the 95 % Wilson interval.

    Only results of the held-out half count, and only those of the version of the sources of the last result. Cases
    without a verdict do not count.
    """
    held_out = [one for one in results if one.plan.half == HALVES[1]]
    digest = held_out[-1].digest if held_out else ""
    of_digest = [one for one in held_out if one.digest == digest and one.verdict is not None]
    return {"sources": digest, "cases": len(of_digest), "verdicts": {kind: _of_kind(of_digest, kind) for kind in KINDS}}


def write_track_record(results: Sequence[Result], path: Path) -> bool:
    """Write the file that the library reads; return whether there are results of the held-out half."""
    record = track_record(results)
    if record["cases"]:
        write_whole(path, json.dumps(record, indent=2) + "\n")
    return bool(record["cases"])


def is_right(hidden: Sequence[Mapping[str, Any]], verdict: Mapping[str, Any]) -> bool:
    """Return whether a verdict is reliable.

    `cause`: all named effects are hidden. `ambiguous`: one of its sets equals the hidden effects. `adequate`: nothing
    is hidden. `unknown`: an effect outside of the library is hidden. For a verdict that names effects, those outside of
    the library do not count, so that a remark on a remainder does not make a wrong name right.
    """
    known = [effect for effect in hidden if effect["in_a_library"]]
    match verdict["verdict"]:
        case "adequate":
            return not hidden
        case "unknown":
            return len(known) < len(hidden)
        case "cause":
            return answer(known, verdict) in (Answer.RIGHT, Answer.PART)
        case _:
            return answer(known, verdict) is Answer.SET


def _of_kind(results: Sequence[Result], kind: str) -> dict[str, float]:
    verdicts = [(one.hidden, one.verdict) for one in results if one.verdict is not None]
    found = Rate.of(is_right(hidden, verdict) for hidden, verdict in verdicts if verdict["verdict"] == kind)
    if not found.n:
        return {"n": 0, "right": 0}
    low, high = found.interval
    return {"n": found.n, "right": found.k, "low": round(low, 4), "high": round(high, 4)}
