"""What free runs of held-out recordings make of a verdict, on trials made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from discovery_laws import a_round, trial
from discovery_verdicts import BAD, GOOD, HALF, WORSE, found, judged, score, scores

from continuum.discovery.confirmation import confirmed
from continuum.discovery.evidence import gain
from continuum.discovery.in_words import verdict_in_words
from continuum.discovery.judgement import judge
from continuum.discovery.measured_gain import RunScore, closed_gap, spread_of, told_gap
from continuum.discovery.verdict import Kind
from continuum.discovery.verdict_json import as_mapping
from continuum.dynamics.reading import Reading
from continuum.identification.recording import Recording

NOTHING_MORE = a_round(HALF, trial("tip_payload", "base_tilt", bad=0.15, seed=3))


def test_the_part_of_the_gap_that_is_closed() -> None:
    def runs(*positions: float) -> list[RunScore]:
        return [score(f"run_{i}", position) for i, position in enumerate(positions)]

    assert closed_gap(runs(0.45, 0.25), runs(0.05, 0.05)) == pytest.approx(1.0)
    assert closed_gap(runs(0.45, 0.25), runs(0.25, 0.15)) == pytest.approx(0.5)
    assert closed_gap(runs(0.45), runs(0.45)) == 0.0
    assert closed_gap(runs(0.25), runs(0.45)) == pytest.approx(-1.0)
    assert closed_gap(runs(0.05), runs(0.05)) == 0.0  # nothing to close
    assert closed_gap(runs(np.inf, 0.25), runs(0.3, 0.25)) == pytest.approx(1 / 1.2)  # one could not be simulated
    assert closed_gap(runs(0.06, 0.45), runs(0.12, 0.05)) > 0.9  # next to the floor a run has no say
    assert closed_gap(runs(np.inf), runs(np.inf)) == 0.0
    assert closed_gap(runs(0.25), runs(np.inf)) == -1.0


def at_rest(*positions: float) -> list[RunScore]:
    """Runs in which joints move by so little that noise alone makes Eq. 19 more than 1."""
    return [score(f"rest_{i}", position, 1.3) for i, position in enumerate(positions)]


def test_a_run_at_rest_gives_no_figure_and_has_a_say_nevertheless() -> None:
    assert told_gap(at_rest(4.0), at_rest(1.3)) == 0.0
    assert told_gap([*at_rest(4.0), *scores(0.45)], [*at_rest(0.6), *scores(0.25)]) == pytest.approx(0.5)
    cause = judged()[Kind.CAUSE]
    assert confirmed(cause, [*scores(0.45), *at_rest(10.2)], [*scores(0.06), *at_rest(1.31)]).kind is Kind.CAUSE
    assert confirmed(cause, at_rest(*[5.1] * 4), at_rest(*[5.1] * 4)).kind is Kind.UNKNOWN
    assert confirmed(cause, at_rest(*[5.1] * 4), at_rest(*[5.3] * 4)).kind is Kind.UNKNOWN


def test_what_helps_in_windows_alone_is_said_not_to_predict() -> None:
    unknown = judged()[Kind.UNKNOWN]
    helps = verdict_in_words(confirmed(unknown, scores(0.45, 0.45), scores(0.30, 0.30)))
    assert "helps" in helps
    for after in (scores(0.47, 0.46), scores(0.45, 0.45), scores(0.44, 0.44)):
        told = verdict_in_words(confirmed(unknown, scores(0.45, 0.45), after))
        assert "does not predict runs that it was not fitted to" in told
        assert "helps" not in told


def test_a_cause_whose_model_predicts_no_held_out_run_is_not_named() -> None:
    for kind, verdict in judged().items():
        named = kind in (Kind.CAUSE, Kind.AMBIGUOUS)
        if kind is Kind.ADEQUATE:
            continue
        assert confirmed(verdict, scores(0.45, 0.45), scores(0.05, 0.25)) is verdict
        assert confirmed(verdict, scores(0.05, 0.04), scores(0.05, 0.05)) is verdict  # nothing to predict better
        doubted = confirmed(verdict, scores(0.45, 0.45), scores(0.44, 0.40))
        assert doubted.kind is (Kind.UNKNOWN if named else kind)
        assert not (named and doubted.alternatives)
        assert ("does not predict runs" in verdict_in_words(doubted)) == named
        assert confirmed(verdict, scores(0.03, 0.03), scores(0.045, 0.045)) is verdict  # nothing to be worse than
        for after in (scores(0.05, 0.31), scores(0.05, np.inf)):  # far off in one run
            assert confirmed(verdict, scores(0.45, 0.45), after).kind is (Kind.UNKNOWN if named else kind)
            assert confirmed(verdict, scores(0.05, 0.04), after).kind is (Kind.UNKNOWN if named else kind)
        for after in (scores(0.05, 0.05, 0.29), scores(0.32, 0.32, 0.32)):  # one far run hardly nearer; all a little
            assert confirmed(verdict, scores(0.45, 0.45, 0.30), after).kind is (Kind.UNKNOWN if named else kind)
        assert confirmed(verdict, scores(0.45, 0.45, 0.18), scores(0.05, 0.05, 0.17)) is verdict  # not far
        assert confirmed(verdict, scores(0.45, 0.45, 0.30), scores(0.05, 0.05, 0.20)) is verdict  # far, and nearer
        assert confirmed(verdict, scores(0.15, 0.15), scores(0.11, 0.11)) is verdict  # two fifths of the way
        assert confirmed(verdict, scores(0.15, 0.15), scores(0.12, 0.12)).kind is (Kind.UNKNOWN if named else kind)
        worse = scores(0.9, 0.10, 0.10, 0.10), scores(0.05, 0.12, 0.12, 0.12)  # in most runs
        assert confirmed(verdict, *worse).kind is (Kind.UNKNOWN if named else kind)
        assert confirmed(verdict, scores(0.9, 0.9, 0.1, 0.1), scores(0.05, 0.05, 0.12, 0.12)) is verdict
    needless = judge(GOOD, [a_round(GOOD, trial("base_tilt", misfit=0.6, seed=3))])
    assert needless.kind is Kind.CAUSE
    assert confirmed(needless, scores(0.14), scores(0.13)).kind is Kind.ADEQUATE
    assert confirmed(needless, scores(0.45), scores(0.44)).kind is Kind.UNKNOWN
    far = [replace(score("run_1", 0.36), spread=0.2)]
    assert confirmed(needless, far, far).vague


def test_no_model_is_adequate_whose_free_runs_end_far_from_what_was_measured() -> None:
    verdict = judged()[Kind.ADEQUATE]
    for near in (scores(0.05, 0.05), scores(0.09, 0.24)):
        assert confirmed(verdict, near, near) is verdict
    for far in (scores(0.05, 0.36), scores(0.05, np.inf)):
        doubted = confirmed(verdict, far, far)
        assert doubted.kind is Kind.UNKNOWN
        assert "does not predict whole runs" in verdict_in_words(doubted)


def test_what_explains_nearly_all_is_the_cause_where_free_runs_say_so() -> None:
    most = trial("tip_payload", bad=0.08, seed=1)
    verdict = judge(
        BAD, [a_round(BAD, most, WORSE), a_round(most, trial("tip_payload", "base_tilt", bad=0.07, seed=3))]
    )
    assert verdict.kind is Kind.UNKNOWN
    assert verdict.to_close == 0.8
    assert [str(cause.addition) for cause in verdict.causes] == ["tip_payload"]  # the second one is not needed for most
    named = confirmed(verdict, scores(0.45, 0.45), scores(0.08, 0.10))
    assert named.kind is Kind.CAUSE
    assert "to 8 %, and that has another cause" in verdict_in_words(named)
    for before, after in (
        ((0.45, 0.45), (0.15, 0.15)),  # too far from the noise
        ((5.0, 0.3, 0.3, 0.3), (0.1, 0.3, 0.3, 0.3)),  # one run does it all
        ((np.inf, np.inf), (0.06, 0.06)),  # beside a model that cannot be simulated anything is better
        ((0.45, 0.45, 0.052), (0.06, 0.06, 2.0)),  # a run ends far from what was measured
    ):
        assert confirmed(verdict, scores(*before), scores(*after)).kind is Kind.UNKNOWN
    assert as_mapping(found(named))["complete"] is False


def test_what_leaves_windows_unexplained_is_the_cause_where_whole_runs_come_to_the_noise() -> None:
    """Joints that stick and slip leave windows of a right model unexplained; a wrong one hardly follows whole runs."""
    verdict = judge(BAD, [a_round(BAD, HALF, WORSE), NOTHING_MORE])
    assert verdict.kind is Kind.UNKNOWN
    far, near = (0.45, 0.45, 0.45), (0.055, 0.06, 0.05)
    named = confirmed(verdict, scores(*far), scores(*near))
    assert named.kind is Kind.CAUSE
    assert "to 15 %, and that has another cause" in verdict_in_words(named)
    closed = closed_gap(scores(*far), scores(*near))
    assert closed < 1
    assert named.causes[0].confidence == pytest.approx(closed * verdict.causes[0].confidence, rel=1e-9)
    assert confirmed(verdict, scores(*far), scores(*near), scores(*near)).kind is Kind.UNKNOWN  # another one as well
    assert confirmed(verdict, scores(*far), scores(*near), scores(*far)).kind is Kind.CAUSE
    assert as_mapping(found(named))["complete"] is False
    for before, after in (
        (far, (0.08, 0.08, 0.08)),  # nearly
        ((9.0, 0.45, 0.45), (0.05, 0.1, 0.1)),  # one run comes all the way, the others nearly
        ((0.09, 0.09, 0.45), near),  # most were hardly away before
        ((np.inf, 0.45, 0.45), near),
        (far[:2], near[:2]),  # two runs, or the parts of a single one
        (far, (0.0, 0.0, 0.12)),  # none below the noise pays for another
        ((*far, *far), (*near, 0.05, 0.05, 0.14)),  # each comes most of the way
        ((*far, 0.11), (0.05, 0.05, 0.05, 0.09)),  # one that was away comes a third of its way
        ((*far, 0.05), (*near, 0.29)),  # one run gets worse, to six times the noise
        ((*far, 0.05, 0.05, 0.05, 0.05), (*near, 0.06, 0.06, 0.06, 0.06)),  # most get worse
    ):
        assert confirmed(verdict, scores(*before), scores(*after)).kind is Kind.UNKNOWN
    assert confirmed(verdict, scores(0.45, 0.45, 0.09), scores(*near)).kind is Kind.CAUSE


def test_whole_runs_name_no_cause_of_two_nor_one_beside_another_that_helps_as_well() -> None:
    far, noise = scores(0.45, 0.45, 0.45), scores(0.05, 0.05, 0.05)
    one, both = trial("tip_payload", bad=0.22), trial("tip_payload", "base_tilt", bad=0.12, seed=3)
    two = judge(BAD, [a_round(BAD, one, WORSE), a_round(one, both)])
    peers = judge(BAD, [a_round(BAD, HALF, trial("base_tilt", bad=0.2, seed=1))])
    assert len(two.causes) == 2
    for verdict in (two, peers):
        assert verdict.to_close is None
        assert confirmed(verdict, far, noise).kind is Kind.UNKNOWN


def test_what_explains_nearly_all_is_no_cause_beside_another_that_helps_as_well() -> None:
    most, rival = (trial(name, bad=bad, seed=1) for name, bad in (("tip_payload", 0.08), ("base_tilt", 0.15)))
    assert gain(rival, BAD).is_significant
    assert judge(BAD, [a_round(BAD, most, rival)]).to_close is None
    assert judge(BAD, [a_round(BAD, HALF, WORSE), NOTHING_MORE]).to_close == 0.95
    assert judge(BAD, [a_round(BAD, HALF, WORSE)]).to_close is None  # nothing further was sought


def test_most_windows_name_no_cause_either_where_free_runs_get_worse() -> None:
    verdict = judge(BAD, [a_round(BAD, trial("tip_payload", bad=0.08, seed=1), WORSE)])
    assert verdict.to_close == 0.8
    worse = scores(0.45, 0.45, 0.05, 0.05, 0.05), scores(0.05, 0.05, 0.29, 0.29, 0.29)
    one_far = scores(0.6, 0.6, 0.6, 0.21), scores(0.05, 0.05, 0.05, 0.25)
    for before, after in (worse, one_far):
        assert confirmed(verdict, before, after).kind is Kind.UNKNOWN


def test_as_far_as_models_go_apart_that_no_window_tells_apart_is_not_far() -> None:
    verdict = judged()[Kind.ADEQUATE]
    for spread, kind in ((0.1, Kind.UNKNOWN), (0.2, Kind.ADEQUATE)):
        far = [replace(score("run_1", 0.36), spread=spread)]
        found_now = confirmed(verdict, far, far)
        assert found_now.kind is kind
        assert ("They leave much open" in verdict_in_words(found_now)) == (kind is Kind.ADEQUATE)


def test_models_go_apart_by_what_was_measured_not_by_what_was_simulated() -> None:
    """A joint that sticks in the simulation and hardly creeps is still as far off as it moved in the data."""
    times = np.linspace(0, 1, 50)
    moved = Recording("run", times, np.stack([0.4 * np.sin(6 * times), 0.2 * np.cos(6 * times)], axis=1))

    def stuck(creep: float, angle: float) -> Reading:
        theta = moved.theta.copy()
        theta[:, 0] = angle + creep * times
        return Reading(times, theta, 0 * theta, ())

    others = [stuck(1e-6, np.deg2rad(0.05) * k) for k in range(8)]
    found_spread = spread_of(stuck(1e-6, 0.0), others, moved)
    assert 0 < found_spread < 0.02
    assert spread_of(others[0], [*others[:2], None, stuck(0.0, 40.0)], moved) < 0.02  # one of them does not decide
    assert spread_of(others[0], [None, None], moved) == 0.0
