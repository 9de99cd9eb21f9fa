"""Every kind of verdict beside every kind of truth."""

from __future__ import annotations

from typing import Any

import pytest

from tools.benchmarks.discovery.answer import Answer, answer, label
from tools.benchmarks.discovery.test.results_by_hand import effect, named, verdict

REST, PAYLOAD, DRAG, MAGNET = (
    effect("rest_angle", 2),
    effect("tip_payload"),
    effect("quadratic_drag"),
    effect("magnet", 2),
)
IS_REST, IS_PAYLOAD, IS_DRAG, IS_TILT = (
    [named("rest_angle", 2)],
    [named("tip_payload")],
    [named("quadratic_drag")],
    [named("base_tilt")],
)


@pytest.mark.parametrize(
    ("hidden", "said", "worth"),
    [
        ([], verdict("adequate"), Answer.RIGHT),
        ([], verdict("cause", IS_PAYLOAD), Answer.WRONG_CAUSE),
        ([], verdict("ambiguous", IS_PAYLOAD, IS_TILT), Answer.WRONG_SET),
        ([], verdict("ambiguous", [], IS_TILT), Answer.SET),
        ([], verdict("unknown"), Answer.UNKNOWN),
        ([REST], verdict("adequate"), Answer.ADEQUATE),
        ([REST], verdict("cause", IS_REST), Answer.RIGHT),
        ([REST], verdict("cause", [named("rest_angle", 3)]), Answer.WRONG_CAUSE),
        ([REST], verdict("cause", [named("rest_angle", 2, 3)]), Answer.WRONG_CAUSE),
        ([REST], verdict("cause", IS_TILT), Answer.WRONG_CAUSE),
        ([REST], verdict("cause", IS_REST + IS_TILT), Answer.WRONG_CAUSE),
        ([REST], verdict("ambiguous", IS_TILT, IS_REST), Answer.SET),
        ([REST], verdict("ambiguous", IS_TILT, IS_REST + IS_PAYLOAD), Answer.WRONG_SET),
        ([REST], None, Answer.FAILED),
        ([PAYLOAD], verdict("cause", IS_PAYLOAD), Answer.RIGHT),
        ([PAYLOAD], verdict("cause", [named("tip_payload", 1, 2, 3, 4, 5)]), Answer.RIGHT),
        ([PAYLOAD], verdict("cause", [named("tip_payload", 1, 3)]), Answer.PART),
        ([PAYLOAD, DRAG], verdict("cause", IS_DRAG + IS_PAYLOAD), Answer.RIGHT),
        ([PAYLOAD, DRAG], verdict("cause", IS_PAYLOAD), Answer.PART),
        ([PAYLOAD, REST], verdict("cause", [*IS_PAYLOAD, named("rest_angle", 1)]), Answer.WRONG_CAUSE),
        ([PAYLOAD, DRAG], verdict("ambiguous", IS_PAYLOAD, IS_PAYLOAD + IS_DRAG), Answer.SET),
        ([PAYLOAD, DRAG], verdict("ambiguous", IS_PAYLOAD, IS_DRAG), Answer.PART),
        ([MAGNET], verdict("unknown", complete=False), Answer.RIGHT),
        ([MAGNET], verdict("cause", IS_TILT, complete=False), Answer.RIGHT),
        ([MAGNET], verdict("cause", IS_TILT), Answer.WRONG_CAUSE),
        ([MAGNET], verdict("ambiguous", IS_TILT, IS_REST), Answer.WRONG_SET),
        ([MAGNET], verdict("adequate"), Answer.ADEQUATE),
    ],
)
def test_worth(hidden: list[dict[str, Any]], said: dict[str, Any] | None, worth: Answer) -> None:
    assert answer(hidden, said) is worth


def test_another_verdict_is_refused() -> None:
    with pytest.raises(ValueError, match="'perhaps'"):
        answer([], verdict("perhaps"))


def test_labels() -> None:
    assert label([]) == "nothing"
    assert label([named("rest_angle", 2, 3), named("capstan")]) == "rest_angle@2,3 + capstan"
