"""What became of one case: plan, truth, verdict, time; kept as one line of JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from blind.plant import Plan

from tools.bench_discovery.plans import kind_of


@dataclass(frozen=True)
class Result:
    """One diagnosis.

    Attributes:
        digest: of the sources that made it.
        plan: of the case.
        truth: what was hidden, as the plant's ``Truth.plain`` has it.
        verdict: as `continuum diagnose --json` writes it; None where there is none.
        failure: why there is none.
        seconds: processor time of the diagnosis alone [s].
        elapsed: time that passed meanwhile [s].
    """

    digest: str
    plan: Plan
    truth: Mapping[str, Any]
    verdict: Mapping[str, Any] | None
    failure: str
    seconds: float
    elapsed: float

    @property
    def kind(self) -> str:
        """`clean`, `one`, `pairs` or `outside`."""
        return kind_of(self.plan.effects)

    @property
    def hidden(self) -> tuple[Mapping[str, Any], ...]:
        """Hidden effects: name, joint, amount, unit, in_a_library."""
        return tuple(self.truth["effects"])


def append(result: Result, path: Path) -> None:
    """Add a result to a file, which is made where there is none."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(asdict(result)) + "\n")


def load(path: Path, digest: str | None) -> list[Result]:
    """Results of one version, or of all, of a case the latest."""
    found: dict[Plan, Result] = {}
    for result in _all(path, digest):
        found.pop(result.plan, None)
        found[result.plan] = result
    return list(found.values())


def superseded(path: Path) -> list[Result]:
    """Results of cases that a later version was asked once more."""
    results = _all(path, None)
    latest = {result.plan: result for result in results}
    return [result for result in results if latest[result.plan] is not result]


def _all(path: Path, digest: str | None) -> list[Result]:
    """In the order in which they were made; a line that was cut off in the writing is left out."""
    found = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else ():
        try:
            fields = json.loads(line)
        except json.JSONDecodeError:
            continue
        plan = fields["plan"]
        fields["plan"] = Plan(**(plan | {"effects": tuple(plan["effects"])}))
        result = Result(**fields)
        if digest in (None, result.digest):
            found.append(result)
    return found
