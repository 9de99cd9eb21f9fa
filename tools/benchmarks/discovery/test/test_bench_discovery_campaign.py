"""Results are kept, and a campaign goes on where a process ends."""

from __future__ import annotations

import itertools
import os
from pathlib import Path

import pytest

from tools.benchmarks.discovery.cases import run_campaign
from tools.benchmarks.discovery.plans import Plan, campaign
from tools.benchmarks.discovery.result import Result, append, load
from tools.benchmarks.discovery.test.results_by_hand import effect, named, result, verdict

pytestmark = pytest.mark.slow

PLANS = list(itertools.islice(campaign("development", 1), 4))


def test_results_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "out" / "results.jsonl"
    some = [
        result([effect("rest_angle", 2)], verdict("cause", [named("rest_angle", 2, angle=(0.1, 0.0, 0.2))])),
        result([], None, number=1),
    ]
    for one in some:
        append(one, path)
    with path.open("a") as file:
        file.write('{"digest": "cut o')
    assert load(path) == some
    assert load(tmp_path / "none") == []


def ready() -> None:
    """Instead of loading what is compiled."""


def measured(plan: Plan, digest: str) -> Result:
    """Instead of a diagnosis."""
    return Result(digest, plan, [], verdict("adequate"), "", 1.0, 1.0)


def fatal(plan: Plan, digest: str) -> Result:
    """Instead of a diagnosis that ends its process."""
    return measured(plan, digest) if plan != PLANS[1] else os._exit(1)


def test_a_campaign_ends_when_it_is_over() -> None:
    asked = itertools.count()
    found = list(run_campaign(iter(PLANS), 2, "0", lambda: next(asked) >= 3, measured, ready))
    assert sorted(one.plan.seed for one in found) == [plan.seed for plan in PLANS[:3]]


def test_a_process_that_ends_is_a_failure_of_its_case_alone() -> None:
    found = {one.plan: one for one in run_campaign(iter(PLANS), 2, "0", lambda: False, fatal, ready)}
    assert set(found) == set(PLANS)
    assert [found[plan].failure for plan in PLANS] == ["", "its process ended", "", ""]
