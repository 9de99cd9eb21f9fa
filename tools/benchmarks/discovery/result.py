"""Result of one case as one line of JSON, with the digest of the sources."""

from __future__ import annotations

import ast
import hashlib
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import blind

import continuum
from tools.benchmarks.discovery.answer import Answer, answer
from tools.benchmarks.discovery.plans import Plan

_PARTS: Final = ("discovery", "estimation", "effects", "dynamics", "identification", "recordings")


@dataclass(frozen=True)
class Result:
    """One diagnosis.

    Attributes:
        digest: digest of the sources that produced it.
        plan: plan of the case.
        hidden: effects as reported by the plant: name, joint, amount, unit, in_a_library.
        verdict: the stored part of the JSON of `continuum diagnose`; None if there is none.
        failure: reason for a missing verdict.
        seconds: processor time of the diagnosis [s].
        memory: peak memory of its process [MiB].
    """

    digest: str
    plan: Plan
    hidden: Sequence[Mapping[str, Any]]
    verdict: Mapping[str, Any] | None
    failure: str
    seconds: float
    memory: float

    @property
    def answer(self) -> Answer:
        """Assessment of the verdict."""
        return answer(self.hidden, self.verdict)

    @property
    def sets(self) -> Sequence[Mapping[str, Any]]:
        """Named sets of effects with their probabilities."""
        return [] if self.verdict is None else list(self.verdict["sets"])


def kept(verdict: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parts of a verdict that the page needs, to four digits, without values of single recordings."""
    short = {name: verdict[name] for name in ("verdict", "complete", "sets", "helps", "shares", "closed")}
    for cause in (cause for one in ({"effects": short["helps"]}, *short["sets"]) for cause in one["effects"]):
        cause["parameters"] = [one for one in cause["parameters"] if one["recording"] is None]
    noise, runs = verdict["open_loop"]["noise"], verdict["open_loop"]["runs"].values()
    short["open_loop"] = {"noise": noise} | {when: [run[when]["rms"] for run in runs] for when in ("before", "after")}
    return dict(_rounded(short))


def _rounded(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _rounded(one) for name, one in value.items()}
    if isinstance(value, list):
        return [_rounded(one) for one in value]
    return float(f"{value:.4g}") if isinstance(value, float) else value


def append(result: Result, path: Path) -> None:
    """Append a result to a file, which is created if it is missing."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(asdict(result)) + "\n")


def load(path: Path) -> list[Result]:
    """Read all results; omit an incompletely written line."""
    found = []
    for line in path.read_text(encoding="utf-8").splitlines() if path.exists() else ():
        try:
            fields = json.loads(line)
        except json.JSONDecodeError:
            continue
        plan = fields["plan"]
        fields["plan"] = Plan(**(plan | {"effects": tuple(plan["effects"])}))
        found.append(Result(**fields))
    return found


def digest_of_sources() -> str:
    """Return a digest, 12 hexadecimal digits, of all sources of library and plants that a verdict may depend on.

    Comments and formatting do not count, but docstrings do.
    """
    library, plants, total = Path(str(continuum.__file__)).parent, Path(str(blind.__file__)).parent, hashlib.sha256()
    for folder in (*(library / part for part in _PARTS), plants / "mujoco_plant", plants / "moreau_plant"):
        for path in sorted(folder.rglob("*.py")):
            tree = ast.dump(ast.parse(path.read_text(encoding="utf-8")))
            total.update(f"{folder.name}/{path.relative_to(folder)} {tree}\n".encode())
    return total.hexdigest()[:12]
