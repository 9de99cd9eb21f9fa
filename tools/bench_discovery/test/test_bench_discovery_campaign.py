"""Plans are balanced, results are kept, and a campaign goes on where it stopped."""

from __future__ import annotations

import itertools
import json
import os
import re
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
from blind.plant import EFFECTS, LIBRARY, OUTSIDE, Plan, make_case, write_case
from blind.plant.regimes import kinds

from tools.bench_discovery.campaign import DiagnosisFailedError, diagnosed, left, run_campaign
from tools.bench_discovery.digest import digest
from tools.bench_discovery.plans import DATASETS, EIGHT, campaign, kind_of, narrowed
from tools.bench_discovery.result import Result, append, load, superseded
from tools.bench_discovery.test.results_by_hand import effect, named, result, verdict

PLANS = list(campaign(1, 10))
A_ROUND = list(campaign(1, 1))


def test_every_seed_is_another() -> None:
    assert len({plan.seed for plan in PLANS}) == len(PLANS)
    assert not {plan.seed for plan in PLANS} & {plan.seed for plan in campaign(2, 10)}
    assert list(campaign(1, 10)) == PLANS


def test_effects_are_hidden_only_where_they_can_be_seen() -> None:
    assert all(EFFECTS[name].seen_in & kinds(plan.dataset) for plan in PLANS for name in plan.effects)


def test_a_round_has_every_effect_at_every_size() -> None:
    found = Counter(
        (plan.effects[0], plan.size) for plan in A_ROUND if len(plan.effects) == 1 and plan.dataset != EIGHT
    )
    assert all(found[name, size] == 1 for name in LIBRARY for size in ("small", "medium", "large"))
    assert all(sum(found[name, size] for size in ("small", "medium", "large")) == 1 for name in OUTSIDE)
    assert len({tuple(plan.effects) for plan in A_ROUND[:21]}) == 21


def test_every_beginning_is_balanced() -> None:
    """From a round on, effects differ by no more than one round; from the first forty cases on, all kinds are there."""
    for end in range(len(A_ROUND), len(PLANS), 7):
        counts = Counter(name for plan in PLANS[:end] if kind_of(plan.effects) == "one" for name in plan.effects)
        assert max(counts[name] for name in LIBRARY) - min(counts[name] for name in LIBRARY) <= 5
    assert {kind_of(plan.effects) for plan in PLANS[:40]} >= {"one", "clean", "outside"}


@pytest.mark.parametrize("name", LIBRARY)
def test_an_effect_meets_datasets_and_noises_in_turn(name: str) -> None:
    mine = [plan for plan in PLANS if plan.effects == (name,) and plan.dataset != EIGHT]
    shown = [dataset for dataset in DATASETS if EFFECTS[name].seen_in & kinds(dataset)]
    datasets, noises = (Counter(getattr(plan, what) for plan in mine) for what in ("dataset", "noise"))
    assert max(datasets.values()) - min(datasets[dataset] for dataset in shown) <= 3
    assert set(noises) == {"low", "ordinary", "high"}
    assert len({(plan.dataset, plan.noise) for plan in mine}) >= 2 * len(shown)


@pytest.mark.parametrize("name", LIBRARY)
def test_campaigns_begin_an_effect_in_several_datasets(name: str) -> None:
    firsts = [next(plan for plan in campaign(seed, 1) if plan.effects == (name,)) for seed in range(8)]
    assert len({plan.dataset for plan in firsts}) >= 2
    assert len({plan.noise for plan in firsts}) >= 2


def test_clean_arms_meet_every_dataset() -> None:
    found = Counter(plan.dataset for plan in A_ROUND if not plan.effects)
    assert set(found) == set(DATASETS)
    assert len(set(found.values())) == 1


def test_a_campaign_may_be_narrowed() -> None:
    assert {kind_of(plan.effects) for plan in narrowed(PLANS, ["clean"])} == {"clean"}
    assert {plan.effects for plan in narrowed(PLANS, ["capstan"])} == {("capstan",)}
    assert {kind_of(plan.effects) for plan in narrowed(PLANS, ["clean", "pairs"])} == {"clean", "pairs"}
    assert list(narrowed(PLANS, [])) == PLANS


def test_results_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "out" / "results.jsonl"
    kept = [
        result([effect("rest_angle", 2)], verdict("cause", named("rest_angle", 2, angle=(0.1, 0.0, 0.2)))),
        result([], None, seed=1),
    ]
    for one in kept:
        append(one, path)
    with path.open("a") as file:
        file.write('{"digest": "cut o')
    assert load(path, None) == kept
    assert load(path, "0123456789ab") == kept
    assert load(path, "another") == []
    assert load(tmp_path / "none", None) == []


def test_of_a_case_that_was_repeated_the_latest_result_counts(tmp_path: Path) -> None:
    path = tmp_path / "results.jsonl"
    old = result([], verdict("unknown"))
    new, other = replace(old, digest="later", verdict=verdict("adequate")), result([], verdict("adequate"), seed=3)
    for one in (old, other, new):
        append(one, path)
    assert load(path, None) == [other, new]
    assert load(path, old.digest) == [old, other]
    assert superseded(path) == [old]


def test_what_is_done_is_not_done_again(tmp_path: Path) -> None:
    path = tmp_path / "results.jsonl"
    done = [result([], verdict("adequate"), plan.size, plan.dataset, plan.seed) for plan in A_ROUND if not plan.effects]
    for one in done:
        append(one, path)
    plans = [one.plan for one in done]
    new = Plan((), "medium", "fast", 7, "ordinary")
    assert list(left([*plans, new], load(path, None))) == [new]


def measured(plan: Plan) -> Result:
    """Instead of a diagnosis."""
    return result([], verdict("adequate"), seed=plan.seed)


def test_a_campaign_in_processes_of_their_own() -> None:
    plans = A_ROUND[:3]
    found = list(run_campaign(iter(plans), 2, measured, lambda: False))
    assert sorted(one.plan.seed for one in found) == [plan.seed for plan in plans]


def test_a_campaign_ends_when_it_is_over() -> None:
    asked = itertools.count()
    found = list(run_campaign(iter(PLANS), 1, measured, lambda: next(asked) >= 2))
    assert [one.plan.seed for one in found] == [plan.seed for plan in PLANS[:2]]


def test_a_diagnosis_that_fails_says_why(tmp_path: Path) -> None:
    (tmp_path / "run_1.csv").write_text("t_s\n0\n")
    with pytest.raises(DiagnosisFailedError, match=r"exit code 2: .*joint angles"):
        diagnosed([tmp_path / "run_1.csv"], 120.0)


def test_a_diagnosis_that_takes_too_long_is_ended(tmp_path: Path) -> None:
    with pytest.raises(DiagnosisFailedError, match=r"within 0\.01 s"):
        diagnosed([tmp_path / "run_1.csv"], 0.01)


def test_the_digest_is_of_names_and_contents(tmp_path: Path) -> None:
    folder = tmp_path / "part"
    folder.mkdir()
    (folder / "a.py").write_text("1")
    (folder / "notes.txt").write_text("1")
    first = digest([folder])
    (folder / "notes.txt").write_text("2")
    assert digest([folder]) == first
    (folder / "a.py").write_text("2")
    second = digest([folder])
    (folder / "a.py").rename(folder / "b.py")
    assert len({first, second, digest([folder])}) == 3


def test_an_analysis_is_told_nothing_but_the_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A test's name, which pytest puts into the environment, is the name of what is hidden."""
    program = tmp_path / "continuum"
    program.write_text(
        "#!/usr/bin/env python3\nimport json, os, sys\n"
        "told = {'words': sys.argv, 'environment': dict(os.environ), 'folder': os.listdir()}\n"
        "open(sys.argv[sys.argv.index('--json') + 1], 'w').write(json.dumps(told))\n"
    )
    program.chmod(0o700)
    monkeypatch.setenv("PATH", f"{tmp_path}{os.pathsep}{os.environ['PATH']}")
    monkeypatch.setenv("HIDDEN", "backlash")
    files = write_case(make_case(["backlash"], dataset=["release"], seconds=0.5, seed=11), tmp_path / "data")
    told = diagnosed(files, 60.0)
    assert told["words"][-len(files) :] == list(map(str, files))
    assert "PYTEST_CURRENT_TEST" not in told["environment"]
    assert told["folder"] == []
    assert not re.search("|".join(EFFECTS), json.dumps(told))
