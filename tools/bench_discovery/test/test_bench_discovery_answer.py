"""Every kind of verdict beside every kind of truth."""

from __future__ import annotations

from typing import Any

import pytest

from tools.bench_discovery.answer import Answer, answer, label
from tools.bench_discovery.test.results_by_hand import effect, named, verdict

REST, PAYLOAD, DRAG, MAGNET = (
    effect("rest_angle", 2),
    effect("tip_payload"),
    effect("quadratic_drag"),
    effect("magnet", 2),
)


@pytest.mark.parametrize(
    ("hidden", "said", "worth"),
    [
        ([], verdict("adequate"), Answer.RIGHT),
        ([], verdict("cause", named("tip_payload")), Answer.WRONG_CAUSE),
        ([], verdict("ambiguous", named("tip_payload"), others=(named("inertia", 5),)), Answer.OTHER_SET),
        ([], verdict("unknown"), Answer.UNKNOWN),
        ([REST], verdict("adequate"), Answer.ADEQUATE),
        ([REST], verdict("cause", named("rest_angle", 2)), Answer.RIGHT),
        ([REST], verdict("cause", named("rest_angle", 3)), Answer.WRONG_JOINT),
        ([REST], verdict("cause", named("base_tilt")), Answer.WRONG_CAUSE),
        ([REST], verdict("cause", named("rest_angle", 2), named("base_tilt")), Answer.WRONG_CAUSE),
        ([REST], verdict("ambiguous", named("base_tilt"), others=(named("rest_angle", 2),)), Answer.SET),
        ([REST], verdict("ambiguous", named("base_tilt"), others=(named("rest_angle", 1),)), Answer.OTHER_SET),
        ([REST], verdict("unknown", named("rest_angle", 2)), Answer.UNKNOWN),
        ([REST], None, Answer.FAILED),
        ([PAYLOAD], verdict("cause", named("tip_payload")), Answer.RIGHT),
        ([PAYLOAD, DRAG], verdict("cause", named("quadratic_drag"), named("tip_payload")), Answer.RIGHT),
        ([PAYLOAD, DRAG], verdict("cause", named("tip_payload")), Answer.PART),
        ([PAYLOAD, REST], verdict("cause", named("tip_payload"), named("rest_angle", 1)), Answer.WRONG_JOINT),
        ([PAYLOAD, DRAG], verdict("ambiguous", named("tip_payload"), others=(named("quadratic_drag"),)), Answer.SET),
        ([PAYLOAD, DRAG], verdict("ambiguous", named("tip_payload"), others=(named("capstan"),)), Answer.OTHER_SET),
        ([MAGNET], verdict("unknown", named("backlash", 2)), Answer.RIGHT),
        ([MAGNET], verdict("cause", named("backlash", 2)), Answer.WRONG_CAUSE),
        ([MAGNET], verdict("ambiguous", named("backlash", 2)), Answer.OTHER_SET),
        ([MAGNET], verdict("adequate"), Answer.ADEQUATE),
    ],
)
def test_worth(hidden: list[dict[str, Any]], said: dict[str, Any] | None, worth: Answer) -> None:
    assert answer(hidden, said) is worth


def test_several_joints_are_not_the_one() -> None:
    wide = named("rest_angle") | {"joints": [2, 3]}
    assert answer([REST], verdict("cause", wide)) is Answer.WRONG_JOINT


@pytest.mark.parametrize(
    ("joints", "worth"), [(None, Answer.RIGHT), ([1, 2, 3, 4, 5], Answer.RIGHT), ([1, 3, 5], Answer.PART)]
)
def test_some_joints_of_an_effect_of_the_whole_arm_are_a_part(joints: list[int] | None, worth: Answer) -> None:
    assert answer([effect("inertia")], verdict("cause", named("inertia") | {"joints": joints})) is worth


def test_another_verdict_is_refused() -> None:
    with pytest.raises(ValueError, match="'perhaps'"):
        answer([], verdict("perhaps"))


def test_labels() -> None:
    assert label(None) == "no verdict"
    assert label(verdict("cause", named("capstan"))) == "capstan"
    assert label(verdict("cause", named("capstan"), named("backlash", 1))) == "several"
    assert label(verdict("unknown", named("capstan"))) == "unknown"
