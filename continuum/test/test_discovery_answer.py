"""No effect is named that may as well be absent."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from discovery_laws import a_round, trial
from discovery_verdicts import BAD, WORSE, found, judged
from identification_laws import releases, small_simulator

import continuum.discovery.answer as asked
from continuum.discovery.candidate import Addition
from continuum.discovery.findings import Estimate, Findings
from continuum.discovery.judgement import judge
from continuum.discovery.verdict import Kind
from continuum.errors import InvalidValueError
from continuum.identification.dataset import Dataset
from continuum.identification.free import Free


def named(effect: str, *estimates: Estimate) -> Findings:
    """Findings that name one effect."""
    verdict = judge(BAD, [a_round(BAD, trial(effect, seed=1), WORSE)])
    assert verdict.kind is Kind.CAUSE
    return replace(found(verdict), estimates=estimates)


def of(name: str, low: float, high: float, run: int | None = None) -> Estimate:
    return Estimate(Free(name, None, run), (low + high) / 2, low, high, "kg")


def test_a_size_that_is_told_from_none_is_enough() -> None:
    assert None is asked.absent_cause(named("tip_payload", of("tip_payload.mass", 0.02, 0.05)))
    assert None is asked.absent_cause(named("base_tilt", of("base_tilt.angle", -0.05, -0.02)))
    offsets = [of("angle_offset.offset", -0.1, 0.1, 0), of("angle_offset.offset", 0.1, 0.2, 1)]
    assert None is asked.absent_cause(named("angle_offset", *offsets))


@pytest.mark.parametrize(("low", "high"), [(0.0, 0.1), (-0.1, 0.1), (1e-6, 0.1), (0.0, 0.0), (-0.1, -1e-6)])
def test_a_size_that_may_as_well_be_none_is_no_cause(low: float, high: float) -> None:
    assert asked.absent_cause(named("tip_payload", of("tip_payload.mass", low, high))) == "tip_payload"


def test_what_only_says_what_an_effect_looks_like_is_no_size() -> None:
    stiff = [of("elastic_cable.lag", 0.0, 0.06), of("elastic_cable.stiffness", 800.0, 1200.0)]
    assert asked.absent_cause(named("elastic_cable", *stiff)) == "elastic_cable"


def test_a_set_in_which_one_may_as_well_be_absent_stays_one() -> None:
    """What helps without a size explains the data as well as the other: that one is not sure to be the cause."""
    both = replace(found(judged()[Kind.AMBIGUOUS]), estimates=(of("tip_payload.mass", 0.02, 0.05),))
    for low, high in ((0.01, 0.02), (-0.01, 0.02)):
        assert None is asked.absent_cause(replace(both, others=((of("base_tilt.angle", low, high),),)))


def test_a_set_of_effects_that_may_all_be_absent_is_none() -> None:
    both = replace(found(judged()[Kind.AMBIGUOUS]), estimates=(of("tip_payload.mass", 0.0, 0.05),))
    least = min((*both.verdict.causes, *both.verdict.alternatives), key=lambda cause: cause.gain.log_likelihood)
    absent = asked.absent_cause(replace(both, others=((of("base_tilt.angle", -0.01, 0.02),),)))
    assert absent == least.addition.effect


@pytest.mark.parametrize("kind", [Kind.ADEQUATE, Kind.UNKNOWN])
def test_where_nothing_is_named_nothing_is_absent(kind: Kind) -> None:
    assert None is asked.absent_cause(replace(found(judged()[kind]), estimates=(of("tip_payload.mass", 0.0, 1.0),)))


def test_all_is_asked_again_without_what_may_as_well_be_absent(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[list[str]] = []
    told: list[str] = []

    def diagnosed(*_given: object, effects: list[str], **_options: object) -> str:
        tried.append(list(effects))
        return effects[0] if effects else "none"

    def worked_out(effect: str, _random: np.random.Generator) -> Findings:
        if effect == "none":
            return found(judged()[Kind.ADEQUATE])
        return named(effect, of(f"{effect}.{'mass' if effect == 'tip_payload' else 'drag'}", *sizes[effect]))

    sizes = {"tip_payload": (0.0, 0.1), "quadratic_drag": (1.0, 2.0)}
    monkeypatch.setattr(asked, "diagnose", diagnosed)
    monkeypatch.setattr(asked, "findings", worked_out)
    runs, model = Dataset(tuple(releases(2, small_simulator(), 0))), small_simulator().model
    diagnosis, answered = asked.answer(runs, model, tell=lambda what, _part: told.append(what), effects=list(sizes))
    assert tried == [["tip_payload", "quadratic_drag"], ["quadratic_drag"]]
    assert diagnosis == "quadratic_drag"
    assert answered.verdict.causes[0].addition == Addition("quadratic_drag")
    assert sum("without tip_payload" in what for what in told) == 1
    assert any("tip_payload" in note for note in answered.notes)
    tried.clear()
    _, answered = asked.answer(runs, model, effects=["tip_payload"])
    assert tried == [["tip_payload"], []]
    assert answered.verdict.kind is Kind.ADEQUATE


def test_of_two_that_hang_together_the_weaker_is_left_out_first() -> None:
    first, second = a_round(BAD, trial("tip_payload", bad=0.15, seed=1)), trial("tip_payload", bad=0.15, seed=1)
    both = replace(trial("base_tilt", seed=2), extension=(*second.extension, Addition("base_tilt")))
    verdict = judge(BAD, [first, a_round(second, both)])
    assert verdict.kind is Kind.CAUSE
    weaker = min(verdict.causes, key=lambda cause: cause.gain.log_likelihood).addition.effect
    sizes = (of("tip_payload.mass", 0.0, 0.1), of("base_tilt.angle", -0.1, 0.1))
    assert asked.absent_cause(replace(found(verdict), estimates=sizes)) == weaker


def test_a_negative_seed_is_refused_before_anything_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(asked, "diagnose")
    with pytest.raises(InvalidValueError, match="seed is -1; allowed: 0 or more"):
        asked.answer(Dataset(tuple(releases(2, small_simulator(), 0))), small_simulator().model, seed=-1)


def test_no_effects_to_try_are_none() -> None:
    runs = Dataset(tuple(releases(2, small_simulator(), 0)))
    assert not asked.diagnose(runs, small_simulator().model, processes=1, effects=[]).rounds[0].looks
