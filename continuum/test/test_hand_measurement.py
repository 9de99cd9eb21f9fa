"""Values measured by hand: what is written is read again, and sets that contradict them are excluded."""

from __future__ import annotations

import contextlib
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_discovery_experiments import candidate, examined

from continuum.discovery import diagnose
from continuum.discovery.hand_measurement import HandMeasurement, check_measured, measurement_of, zeros_set
from continuum.discovery.hand_misfit import misfit, value_and_sd
from continuum.discovery.hand_tests import hand_tests
from continuum.discovery.problem import Problem
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model_file import load_model
from continuum.errors import InvalidValueError

PLACES = [(effect, name) for effect in effect_names() for name in effect_named(effect).parameters]


@st.composite
def measurements(draw: st.DrawFn) -> HandMeasurement:
    effect, name = draw(st.sampled_from(PLACES))
    spec = effect_named(effect).parameters[name]
    value = draw(st.floats(spec.lower, spec.upper))
    joint = draw(st.integers(0, 40)) if spec.per_joint else None
    recording = draw(st.text("abc_0 .-@[]+é", min_size=1).map(str.strip).filter(bool)) if spec.per_recording else None
    return HandMeasurement(effect, name, joint, value, draw(st.floats(1e-9, 1e9)), recording)


@given(measurements(), st.sampled_from(["+-", "±", "+/-", " +- "]))
def test_what_is_written_is_read_again(one: HandMeasurement, sign: str) -> None:
    assert measurement_of(f"{one.name}={one.value!r}{sign}{one.sd!r}") == one


@given(st.text(max_size=30))
def test_any_text_is_read_or_refused(text: str) -> None:
    with contextlib.suppress(InvalidValueError):
        measurement_of(text)


def test_without_a_deviation_it_is_that_of_the_usual_instrument() -> None:
    assert measurement_of("tip_payload.mass=0.05").sd == effect_named("tip_payload").parameters["mass"].by_hand


@pytest.mark.parametrize(
    "text",
    [
        "", "tip_payload", "tip_payload.mass", "tip_payload.mass=", "tip_payload.mass=a", "tip_payload.weight=1",
        "payload.mass=1", "tip_payload.mass=-1", "tip_payload.mass=nan", "tip_payload.mass=1+-0",
        "tip_payload.mass=1+--1", "tip_payload.mass=1+-inf", "tip_payload.mass[1]=1", "rest_angle.angle=0",
        "angle_offset.offset[1]=0", "rest_angle.angle[1]@run=0", "actuator_lag.lag=0+-x",
    ],
)  # fmt: skip
def test_a_measurement_that_cannot_be_is_refused(text: str) -> None:
    with pytest.raises(InvalidValueError):
        measurement_of(text)


@pytest.mark.parametrize(
    "texts",
    [
        ["rest_angle.angle[6]=0"], ["rest_angle.angle[0]=0"], ["backlash.gap[1]=0"],
        ["angle_offset.offset[1]@other=0"], ["rest_angle.angle[1]=0", "rest_angle.angle[1]=0.1"],
    ],
)  # fmt: skip
def test_what_this_arm_or_these_recordings_lack_is_refused(texts: list[str]) -> None:
    offered = [effect_named("rest_angle"), effect_named("angle_offset")]
    with pytest.raises(InvalidValueError):
        check_measured([measurement_of(text) for text in texts], offered, 5, ["run"])


def problem(*measured: HandMeasurement) -> Problem:
    return replace(examined()[0].problem, measured=measured)


def test_a_set_without_an_effect_says_that_there_is_none() -> None:
    fit = candidate("angle_offset@3").fit
    assert value_and_sd(fit, ("tip_payload", "mass", -1)) == (0.0, 0.0)
    value, sd = value_and_sd(candidate("rest_angle@3").fit, ("rest_angle", "angle", 2))
    assert abs(value - 0.07) < 5 * sd


def test_a_misfit_counts_deviations_and_adds_up() -> None:
    fit = candidate("angle_offset@3").fit
    mass = HandMeasurement("tip_payload", "mass", None, 0.03, 0.01)
    angle = HandMeasurement("rest_angle", "angle", 2, 0.08, 0.04)
    assert misfit(problem(mass), fit) == pytest.approx(9.0)
    assert misfit(problem(mass, angle), fit) == pytest.approx(13.0)


def test_zeros_that_were_set_differ_by_what_a_set_makes_of_them_in_that_recording() -> None:
    """A constant offset of 3 degrees is at odds with one recording's zero; no other joint's is."""
    _, recordings = examined()
    offset, rest = (candidate(label).fit for label in ("angle_offset@3", "rest_angle@3"))
    zeros = problem(*zeros_set(recordings[1].name, 5))
    assert misfit(zeros, offset) > 30
    assert misfit(zeros, rest) < 1


def test_the_value_that_tells_two_sets_apart_is_one_about_which_they_differ() -> None:
    found, _ = examined()
    (test,) = hand_tests(found, [candidate("angle_offset@3"), candidate("rest_angle@3")])
    assert test.name == "rest_angle.angle[3]"
    assert test.decides
    assert not hand_tests(found, [candidate("rest_angle@3")] * 2)


@pytest.mark.parametrize(("angle", "named"), [(0.07, "rest_angle@3"), (0.0, "angle_offset@3")])
def test_a_diagnosis_excludes_what_a_measurement_contradicts(angle: float, named: str) -> None:
    recordings = examined()[1]
    measured = [HandMeasurement("rest_angle", "angle", 2, angle, 0.01)]
    result = diagnose(recordings, load_model("lamecc_prototype.yaml"), with_power=False, measured=measured)
    labels = {cause.label for causes in result.sets for cause in causes}
    assert named in labels or (named == "angle_offset@3" and "angle_offset@1,2,3,4,5" in labels)
    assert ("rest_angle@3" in labels) == (angle > 0)
    assert np.isfinite(result.after.of_segments)
