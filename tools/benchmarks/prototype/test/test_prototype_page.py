"""The page says what was found, whatever that is; nothing else of the workspace looks at the run."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from continuum.discovery import Diagnosis
from continuum.discovery.decision import Kind, Verdict
from continuum.discovery.fit_result import OpenLoop
from continuum.discovery.result import Cause, Share
from continuum.dynamics.model_file import load_model
from continuum.identification.estimate import Estimate
from continuum.recordings.recording import Recording
from tools.benchmarks.prototype.account import DATA, Account, Predicted
from tools.benchmarks.prototype.figures import record_of
from tools.benchmarks.prototype.page import page
from tools.benchmarks.prototype.picture import draw
from tools.benchmarks.prototype.stability import Said

ROOT = Path(__file__).resolve().parents[4]
TIMES = np.arange(49) / 120
THETA = np.outer(np.cos(TIMES), np.linspace(0.1, 0.5, 5))
MODEL = load_model("lamecc_prototype.yaml")


def cause(effect: str, joints: tuple[int, ...] | None, share: float) -> Cause:
    value = Estimate(f"{effect}.mass", None, "", 0.3, 0.2, 0.4, "1", "a part")
    return Cause(effect, joints, Share(share, share, share), 30.0, (value,) if effect == "inertia" else ())


OFFSET, GUESS = cause("angle_offset", (2,), 0.5), cause("inertia", (0, 4), 0.1)


def diagnosis(kind: Kind, *sets: tuple[Cause, ...]) -> Diagnosis:
    verdict = Verdict(kind, (), (0.7, 0.3)[: len(sets)], False)
    closed = Share(sum(one.share.value for one in sets[0]) if sets else 0.0, 0.4, 0.7)
    before, after = (OpenLoop((by * THETA,), 1e-4, 1e-3) for by in (1.1, 1.05))
    sigma, course = np.full(5, 0.03), (np.zeros((49, 5)),)
    return Diagnosis(
        verdict, sets, closed, (sigma, 0.5 * sigma), (course, course), (), before, after, MODEL, MODEL,
        (Recording("rep7", TIMES, THETA),), (), (), (), ((), np.zeros((0, 0))), ("few recordings",), 0.01, 1.0,
    )  # fmt: skip


def account(result: Diagnosis) -> Account:
    same, other = Said("Haswell", "cause", ["angle_offset@3"], 0.5), Said("Zen", "unknown", [], -0.1)
    predicted = [Predicted("refitted", "smoothed", np.full(5, 2.0), np.full(5, 0.7))]
    sd = np.array([3.0, 2.0, 1.0, 0.1, 0.02])
    alone = [("angle_offset@3", 0.7), ("inertia@1,5", 0.1)]
    again = [("nothing", same), ("kernel", same)], [("nothing", same), ("0.03 degrees, draw 1", other)]
    return Account(result, THETA, *again, result, predicted, sd, alone, ("inertia@2", 0.2))


RESULTS = {
    "adequate": diagnosis(Kind.ADEQUATE),
    "cause": diagnosis(Kind.CAUSE, (OFFSET,)),
    "the guess": diagnosis(Kind.CAUSE, (OFFSET, GUESS)),
    "ambiguous": diagnosis(Kind.AMBIGUOUS, (OFFSET,), (GUESS,)),
    "unknown": diagnosis(Kind.UNKNOWN, (GUESS,)),
    "unknown, no help": diagnosis(Kind.UNKNOWN),
}
PAGES = {name: " ".join(page(account(result)).split()) for name, result in RESULTS.items()}


@pytest.mark.parametrize("name", RESULTS)
def test_tables_and_lines_are_whole(name: str) -> None:
    text = page(account(RESULTS[name]))
    for table in re.findall(r"(?:^\|.*\|\n)+", text, re.MULTILINE):
        assert len({line.count("|") for line in table.splitlines()}) == 1
    assert all(len(line) <= 120 for line in text.splitlines() if not line.startswith(("|", "-")))


@pytest.mark.parametrize("name", RESULTS)
def test_errors_are_by_what_was_measured(name: str) -> None:
    *extended, refitted = record_of(account(RESULTS[name])).figures
    scale = np.sqrt(np.mean(THETA**2, axis=0)) / np.std(THETA, axis=0)
    assert refitted.value == pytest.approx(0.1 * np.mean(scale))
    assert [figure.value for figure in extended] == pytest.approx([0.05 * np.mean(scale)] * RESULTS[name].is_extended)
    assert {figure.rival_value for figure in (*extended, refitted)} == {0.0}


@pytest.mark.parametrize("name", ["adequate", "cause"])
def test_the_picture_is_drawn(name: str, tmp_path: Path) -> None:
    draw(account(RESULTS[name]), tmp_path / "prototype.png")
    assert (tmp_path / "prototype.png").stat().st_size > 5000


def test_nothing_else_reads_the_run() -> None:
    """What could be tuned to it: code, models and tests; but for this tool and the reproduction of the thesis."""
    kinds = {".py", ".yaml", ".xml", ".toml", ".cfg"}
    made = {".venv", "build", "install", "log", "out", ".git"}
    sources = [path for path in ROOT.rglob("*") if path.suffix in kinds and path.relative_to(ROOT).parts[0] not in made]
    assert (DATA / "rep7_measured.csv").exists()
    readers = {path.relative_to(ROOT).parts[:3] for path in sources if "rep7" in path.read_text(encoding="utf-8")}
    assert readers == {("tools", "benchmarks", "prototype"), ("tools", "benchmarks", "reproduction")}
