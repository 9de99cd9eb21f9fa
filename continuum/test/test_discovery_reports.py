"""Verdicts in words and for machines, on trials made by hand."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from discovery_laws import a_round, trial
from discovery_verdicts import BAD, PAYLOAD, RUN, WORSE, found, judged, score
from dynamics_laws import prototype_model
from identification_laws import white_noise

from continuum.cli.diagnose import show
from continuum.discovery.candidate import Addition
from continuum.discovery.diagnose import Diagnosis
from continuum.discovery.findings import Estimate, Other, as_given, best_other
from continuum.discovery.in_words import (
    cost_in_words,
    identifiability_in_words,
    lookalikes_in_words,
    verdict_in_words,
    worth_in_words,
)
from continuum.discovery.judgement import judge
from continuum.discovery.motion_phases import PHASES
from continuum.discovery.question import Question
from continuum.discovery.verdict import Kind
from continuum.discovery.verdict_json import as_mapping, write_json
from continuum.dynamics.effect_lookup import effect_named
from continuum.errors import FileError
from continuum.identification.fisher import Identifiability
from continuum.identification.free import Free


def test_every_kind_in_words() -> None:
    told = {kind: verdict_in_words(verdict) for kind, verdict in judged().items()}
    assert "as well as the sensors allow" in told[Kind.ADEQUATE]
    assert told[Kind.CAUSE].startswith(effect_named("tip_payload").in_words)
    assert "from 30 % of the data to 0 %" in told[Kind.CAUSE]
    payload, tilt = (effect_named(name).in_words.rstrip(".") for name in ("tip_payload", "base_tilt"))
    assert f"tip_payload ({payload}); base_tilt ({tilt})" in told[Kind.AMBIGUOUS]
    assert effect_named("base_tilt").experiment in told[Kind.AMBIGUOUS]
    assert f"no effect that is known here explains why. tip_payload ({payload}) helps, yet 15 %" in told[Kind.UNKNOWN]
    assert "None even helps" in verdict_in_words(judge(BAD, []))
    at_joints = trial(Addition("rest_angle", (0, 3)), seed=5)
    assert "(joints 1, 4)" in verdict_in_words(judge(BAD, [a_round(BAD, at_joints)]))
    for text in told.values():
        assert 2 <= text.count(". ") + text.endswith(".") <= 6


def test_what_a_simulation_costs_is_told_by_the_usual_run() -> None:
    quick, slow = ([replace(score("run", 0.1), seconds=s) for s in seconds] for seconds in ((0.01, 9.0, 0.01), (0.03,)))
    assert cost_in_words(quick, slow) == "simulating a run takes 30 ms instead of 10 ms"
    assert cost_in_words(quick, quick) == "simulating a run takes 10 ms, as before"


@pytest.mark.parametrize("kind", [Kind.ADEQUATE, Kind.CAUSE])
def test_the_terminal_shows_models_that_there_are_and_angles_in_degrees(
    kind: Kind, capsys: pytest.CaptureFixture[str]
) -> None:
    told = found(judged()[kind])
    angle = Estimate(Free("base_tilt.angle"), np.radians(3.0), 0.01, 0.1, "rad", at_limit=True)
    gain = Estimate(Free("tension_scale.gain_1"), 0.1, 0.0, 0.2, "1")
    show(replace(told, estimates=(angle, gain)))
    out = "\n".join(line.rstrip() for line in capsys.readouterr().out.splitlines())
    assert "0.05236 (0.01 to 0.1) rad = 3 degrees, at the limit\n" in out
    assert "0.1 (0 to 0.2)\n" in out
    assert "\nRate, of the angles' slopes: Eq. 19" in out  # RUN has no rates
    assert ("refitted -> extended model" in out) == (" -> " in out) == (kind is Kind.CAUSE)


def test_the_terminal_calls_no_candidate_of_several_the_cause(capsys: pytest.CaptureFixture[str]) -> None:
    for kind, title in ((Kind.CAUSE, "cause: "), (Kind.AMBIGUOUS, "may be: ")):
        verdict = judged()[kind]
        show(found(verdict))
        lines = capsys.readouterr().out.splitlines()
        named = [line for line in lines if line.startswith(("cause: ", "may be: "))]
        assert len(named) == len(verdict.causes) + len(verdict.alternatives)
        assert all(line.startswith(title) for line in named)


def test_runs_stand_in_the_order_in_which_they_were_given() -> None:
    recordings = [replace(RUN, name=name) for name in ("b", "a", "c")]
    given = as_given([score(name, 0.1) for name in ("a", "c", "b")], recordings)
    assert [one.name for one in given] == ["b", "a", "c"]
    parts = as_given([score("b, end", 0.1), score("b, beginning", 0.1)], recordings[:1])
    assert [one.name for one in parts] == ["b, end", "b, beginning"]


def test_what_an_extension_is_worth_may_be_less_than_nothing() -> None:
    assert "closes 50 %" in worth_in_words(0.5)
    assert worth_in_words(-0.01).endswith("no better")
    assert "worse" in worth_in_words(-0.1)


@pytest.mark.parametrize("kind", Kind)
def test_every_kind_for_machines(kind: Kind, tmp_path: Path) -> None:
    verdict = judged()[kind]
    made = {"model": "arm.yaml", "recordings": ["run_1.csv", "run_2.csv"], "seed": 3}
    write_json(found(verdict), tmp_path / "verdict.json", made)
    read = json.loads((tmp_path / "verdict.json").read_text(encoding="utf-8"))
    assert read == as_mapping(found(verdict)) | {"made": made}
    assert read["verdict"] == kind.value
    named, empty = ("helps", "causes") if kind is Kind.UNKNOWN else ("causes", "helps")
    assert [one["effect"] for one in read[named]] == [c.addition.effect for c in verdict.causes]
    assert read[empty] == []
    assert [one["effect"] for one in read["alternatives"]] == [c.addition.effect for c in verdict.alternatives]
    for one in (*read[named], *read["alternatives"]):
        assert 0 <= one["confidence"] <= 1
        assert set(one["parameters"]) == set(effect_named(one["effect"]).parameters)
        for entry in one["parameters"].values():
            assert entry["low"] <= entry["value"] <= entry["high"]
    one, other = (read["nrmse_position"][run] for run in ("run_1", "run_2"))
    assert (one["before"], one["after"], other["before"], other["after"]) == (0.4, 0.1, None, 0.2)
    assert one["before_interval"] == [0.3, 0.5]
    assert other["before_interval"] == [None, None]
    assert read["nrmse_velocity"]["run_1"]["after"] == 0.2
    assert set(read["errors_by_phase"]["before"]) == set(PHASES)
    assert (read["weakness"], read["notes"]) == ("two recordings only", ["run_1: row 7 left out"])


@pytest.mark.parametrize(("joints", "joint"), [((2,), 3), ((0, 3), None), (None, None)])
def test_joints_for_machines_count_from_one(joints: tuple[int, ...] | None, joint: int | None) -> None:
    verdict = judge(BAD, [a_round(BAD, trial(Addition("rest_angle", joints), seed=5))])
    (cause,) = as_mapping(found(verdict))["causes"]
    assert cause["joint"] == joint
    assert cause["joints"] == (None if joints is None else [j + 1 for j in joints])


def test_a_file_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be written"):
        write_json(found(judged()[Kind.CAUSE]), tmp_path, {})


def test_what_would_look_the_same_and_is_not_in_the_library_is_told() -> None:
    payload = trial("tip_payload", seed=1)
    for named, effects in (("inertia", ["inertia"]), ("angle_offset", ["angle_offset"]), ("base_tilt", [])):
        for leaders in ((trial(named, seed=1), trial("rest_angle", seed=2)), (payload, trial(named, seed=2))):
            verdict = judge(BAD, [a_round(BAD, *leaders)])
            assert verdict.kind is Kind.AMBIGUOUS
            assert lookalikes_in_words(verdict) == [f"{name}: {effect_named(name).beware}" for name in effects]
            assert lookalikes_in_words(replace(verdict, kind=Kind.UNKNOWN)) == []


@pytest.mark.parametrize(
    ("amounts", "words"),
    [
        ((0.9, 0.1), "rubs more than the others"),
        ((-0.4, -0.1), "rubs less than the others"),
        ((0.9, -0.1), "tighter or looser"),
    ],
)
def test_a_mechanic_is_told_which_way_it_is_off(amounts: tuple[float, float], words: str) -> None:
    unknowns = (Free("stiffness"), Free("joint_friction.coulomb", 2), Free("joint_friction.viscous", 2))
    found_so = replace(
        trial(Addition("joint_friction", (2,)), seed=5), unknowns=unknowns, amounts=np.array([-0.1, *amounts])
    )
    verdict = judge(BAD, [a_round(BAD, found_so)])
    assert words in verdict_in_words(verdict)
    assert "(joint 3)" in verdict_in_words(verdict)


def test_the_best_other_effect_is_told() -> None:
    verdict, rounds = judged()[Kind.CAUSE], (a_round(BAD, PAYLOAD, WORSE),)
    asked = Question(prototype_model(), (), (), white_noise())
    assert best_other(Diagnosis(asked, rounds, verdict)) is WORSE
    assert best_other(Diagnosis(asked, rounds, replace(verdict, kind=Kind.AMBIGUOUS))) is None
    assert best_other(Diagnosis(asked, (a_round(BAD, PAYLOAD),), verdict)) is None
    assert as_mapping(found(verdict))["best_other"] is None
    told = replace(found(verdict), other=Other(Addition("rest_angle", (2,)), 0.123))
    assert as_mapping(told)["best_other"] == {"effect": "rest_angle", "joints": [3], "gap_closed": 0.123}


def test_a_small_effect_is_called_one() -> None:
    verdict = judged()[Kind.CAUSE]
    assert "falls from 30 % of the data to 0 %" in verdict_in_words(verdict)
    small = verdict_in_words(replace(verdict, unexplained=(0.004, 0.001)))
    assert "falls" not in small
    assert "That is little here" in small


def test_an_unknown_cause_asks_for_more_runs() -> None:
    assert "record three more runs" in verdict_in_words(judged()[Kind.UNKNOWN])
    assert "record three more runs" not in verdict_in_words(judged()[Kind.CAUSE])


def test_what_the_data_tell_at_all_is_told() -> None:
    one, other = Free("stiffness"), Free("tip_payload.mass")
    tied = Identifiability((one, other), np.array([1.0, 0.1]), np.array([[1.0, -0.97], [-0.97, 1.0]]), 300.0, 1)
    lines = " ".join(identifiability_in_words(tied))
    assert "1 directions among 2 unknowns" in lines
    assert "300 times" in lines
    assert "stiffness and tip_payload.mass (-0.97)" in lines
    assert "tell little: tip_payload.mass." in lines
    gains = tuple(Free("sensor_scale.gain", joint) for joint in range(4))
    lines = " ".join(identifiability_in_words(Identifiability(gains, np.ones(4), np.full((4, 4), 0.99), 10.0, 1)))
    assert lines.count("(+0.99)") == 4
    assert "and 2 more pairs." in lines
    assert as_mapping(replace(found(judged()[Kind.CAUSE]), identifiability=tied))["identifiability"] == {
        "unknowns": 2,
        "rank": 1,
        "condition": 300.0,
        "entangled": [["stiffness", "tip_payload.mass", -0.97]],
        "untold": ["tip_payload.mass"],
    }
