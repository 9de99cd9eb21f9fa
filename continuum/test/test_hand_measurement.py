"""Values measured by hand: what is written is read again, and every model of a diagnosis has them."""

from __future__ import annotations

import contextlib
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_discovery_experiments import candidate, examined, releases

from continuum.discovery import diagnose
from continuum.discovery.decision import Kind
from continuum.discovery.hand_measurement import HandMeasurement, check_measured, measurement_of, with_measured
from continuum.discovery.hand_tests import hand_tests, value_and_sd
from continuum.discovery.power_words import option
from continuum.discovery.result import Diagnosis
from continuum.discovery.zeros_by_hand import WIDENING, agreement, probability
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model_file import load_model
from continuum.dynamics.parameters import RATIO
from continuum.errors import InvalidValueError

ARM = load_model("lamecc_prototype.yaml")
PLACES = [
    (effect, name) for effect in effect_names() for name, spec in effect_named(effect).parameters.items()
    if spec.by_hand is not None and not spec.per_recording
]  # fmt: skip
SAID = {"rad": ("deg", np.pi / 180), "kg": ("g", 1e-3), "s": ("ms", 1e-3), "1": ("%", 0.01)}


@st.composite
def measurements(draw: st.DrawFn) -> HandMeasurement:
    effect, name = draw(st.sampled_from(PLACES))
    spec = effect_named(effect).parameters[name]
    value = draw(st.floats(max(spec.lower, -5), min(spec.upper, 5)))
    joint = draw(st.integers(0, 40)) if spec.per_joint else None
    return HandMeasurement(effect, name, joint, value, draw(st.floats(1e-6, 1e3)))


@given(measurements(), st.sampled_from(["+-", "±", "+/-", " +- "]), st.booleans())
def test_what_is_written_is_read_again_in_either_unit(one: HandMeasurement, sign: str, is_si: bool) -> None:
    spec = effect_named(one.effect).parameters[one.parameter]
    is_ratio = spec.meaning.endswith(RATIO)
    unit, factor = ("" if spec.unit == "1" else spec.unit, 1.0) if is_si and not is_ratio else SAID[spec.unit]
    found = measurement_of(f"{one.name}={one.value / factor!r}{sign}{one.sd / factor!r} {unit}")
    assert (found.effect, found.parameter, found.joint) == (one.effect, one.parameter, one.joint)
    np.testing.assert_allclose([found.value, found.sd], [one.value, one.sd], rtol=1e-12, atol=1e-300)


@pytest.mark.parametrize(("effect", "name"), PLACES)
def test_an_instrument_sees_an_effect_of_typical_size(effect: str, name: str) -> None:
    spec = effect_named(effect).parameters[name]
    assert spec.by_hand is not None
    assert 0 < 2 * spec.by_hand.sd < (spec.typical or np.inf)


@given(st.text(max_size=30))
def test_any_text_is_read_or_refused(text: str) -> None:
    with contextlib.suppress(InvalidValueError):
        measurement_of(text)


@pytest.mark.parametrize(
    "text",
    [
        "", "tip_payload", "tip_payload.mass", "tip_payload.mass=", "tip_payload.mass=a", "tip_payload.weight=1kg",
        "payload.mass=1kg", "tip_payload.mass=-1kg", "tip_payload.mass=nan", "tip_payload.mass=1+-0kg",
        "tip_payload.mass=5", "tip_payload.mass=5deg", "tip_payload.mass[1]=1kg", "rest_angle.angle=0",
        "rest_angle.angle[3]=0.6", "angle_offset.offset[1]=0", "joint_stiffness.excess[1]=0",
        "elastic_cable.stiffness=5", "inertia.mass[5]=0.2", "inertia.mass[5]=200g",
    ],
)  # fmt: skip
def test_a_measurement_that_cannot_be_is_refused(text: str) -> None:
    """Without a unit nobody knows whether grams or kilograms are meant; none counts from what a fit changes."""
    with pytest.raises(InvalidValueError):
        measurement_of(text)


@pytest.mark.parametrize(
    "texts",
    [["rest_angle.angle[6]=0"], ["rest_angle.angle[0]=0"], ["rest_angle.angle[1]=0", "rest_angle.angle[1]=2deg"]],
)
def test_what_this_arm_lacks_is_refused(texts: list[str]) -> None:
    with pytest.raises(InvalidValueError):
        check_measured([measurement_of(text) for text in texts], ARM)


def test_what_the_model_has_already_is_refused() -> None:
    payload = measurement_of("tip_payload.mass=50g")
    with pytest.raises(InvalidValueError):
        check_measured([payload], with_measured(ARM, [payload]))


def named(result: Diagnosis) -> set[str]:
    return {cause.label for causes in result.sets for cause in causes}


def test_the_value_that_separates_two_sets_is_one_in_which_they_differ() -> None:
    found, _ = examined()
    (test,) = hand_tests(found, [candidate("angle_offset@3"), candidate("rest_angle@3")])
    assert test.name == "rest_angle.angle[3]"
    assert test.decides
    assert measurement_of(option(test).split()[1].replace("VALUE", "4")).value == pytest.approx(np.radians(4))
    assert not hand_tests(found, [candidate("rest_angle@3")] * 2)


def test_a_set_without_an_effect_says_that_there_is_none() -> None:
    assert value_and_sd(candidate("angle_offset@3").fit, ("tip_payload", "mass", -1)) == (0.0, 0.0)
    value, sd = value_and_sd(candidate("rest_angle@3").fit, ("rest_angle", "angle", 2))
    assert abs(value - 0.07) < 5 * sd


@pytest.mark.parametrize("angle", [0.07, 0.0])
def test_what_was_measured_is_in_every_model_and_no_hypothesis(angle: float) -> None:
    """Measured to be there, it is all that was missing; measured to be none, what resembles it is left."""
    recordings = examined()[1]
    measured = [HandMeasurement("rest_angle", "angle", 2, angle, 0.01)]
    result = diagnose(recordings, ARM, with_power=False, measured=measured)
    assert not {"rest_angle@3", "rest_angle@1,2,3,4,5"} & named(result)
    if angle:
        assert result.verdict.kind is Kind.ADEQUATE
        (kept,) = (one for one in result.extended_model.effects if one.effect.name == "rest_angle")
        np.testing.assert_allclose(kept.values["angle"], [0, 0, 0.07, 0, 0], atol=0.025)
    else:
        assert any(label.startswith("angle_offset@") for label in named(result))


def test_another_true_value_does_not_hide_a_cause() -> None:
    """A small weight is measured, a spring at another joint is what matters."""
    payload = measurement_of("tip_payload.mass=12g")
    stiff = with_measured(ARM, [payload]).with_values({"stiffness": list(ARM.parameters.stiffness * [1, 1, 1.6, 1, 1])})
    result = diagnose(releases(stiff, 1.2, -0.9), ARM, with_power=False, measured=[payload])
    assert named(result) == {"joint_stiffness@3"}


def test_a_measured_part_of_an_effect_leaves_the_rest_of_it_open() -> None:
    """One rest angle is known, another one is found."""
    rest = list(ARM.parameters.rest_angle + np.array([0.0, 0.0, 0.05, 0.0, -0.08]))
    recordings = releases(ARM.with_values({"rest_angle": rest}), 1.2, -0.9)
    result = diagnose(
        recordings, ARM, with_power=False, measured=[HandMeasurement("rest_angle", "angle", 2, 0.05, 0.01)]
    )
    assert "rest_angle@5" in named(result)
    assert "rest_angle@3" not in named(result)


def test_a_value_that_the_recordings_contradict_is_questioned() -> None:
    recordings = examined()[1]
    result = diagnose(recordings, ARM, with_power=False, measured=[measurement_of("rest_angle.angle[3]=8+-0.2deg")])
    assert any("measure it again" in note for note in result.notes)
    right = diagnose(recordings, ARM, with_power=False, measured=[measurement_of("rest_angle.angle[3]=4deg")])
    assert not any("measure it again" in note for note in right.notes)


@pytest.mark.parametrize("effect", ["inertia", "payload"])
def test_only_what_can_be_taken_off_can_be_left_out(effect: str) -> None:
    with pytest.raises(InvalidValueError):
        diagnose(examined()[1], ARM, without=[effect])


def test_zeros_that_were_set_exclude_offsets_in_that_recording() -> None:
    found, recordings = examined()
    offset, rest = candidate("angle_offset@3").fit, candidate("rest_angle@3").fit
    zeroed = replace(found.problem, zeroed=frozenset({1}))
    assert agreement(zeroed, offset) < 1e-6
    assert agreement(zeroed, rest) == 1.0
    result = diagnose(recordings, ARM, with_power=False, zeroed=[1])
    assert not any(label.startswith("angle_offset") for label in named(result))


def test_values_in_each_recording_hold_the_one_that_all_may_share() -> None:
    """A base plate that hangs askew alike in all runs is not hung differently in every run."""
    tilted = ARM.with_values({"hang_angle": ARM.parameters.hang_angle + 0.06})
    result = diagnose(releases(tilted, 1.2, -0.9, 0.8), ARM, with_power=False)
    assert "base_tilt" in named(result)
    assert "remounted_base" not in named(result)


def test_zeros_are_as_far_as_chance_has_them_as_often_as_is_said() -> None:
    random = np.random.default_rng(3)
    drawn = random.normal(0, np.hypot(0.005, WIDENING * 0.004), (4000, 3))
    found = np.array([probability([(float(v), 0.004, 0.005) for v in row]) for row in drawn])
    assert abs(np.mean(found < 0.05) - 0.05) < 0.012
