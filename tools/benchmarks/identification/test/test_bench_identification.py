"""The comparison takes errors without sign, the worst for the goal, and counts intervals over arms and parameters."""

import pytest

from continuum.identification.free import THESIS_PARAMETERS
from tools.benchmarks.identification.answers import Answer
from tools.benchmarks.identification.comparison import Comparison, record_of


def comparison(error: float) -> Comparison:
    """A fit that is off by a relative error, one of five intervals missing the truth, and a swarm twice as far off."""
    return Comparison(
        Answer((error,) * 5, (True, True, False, True, True), 0.05, 8.0), Answer((-2 * error,) * 5, None, 0.3, 30.0)
    )


def test_errors_are_medians_and_worst_without_sign() -> None:
    rows = record_of([comparison(0.01), comparison(-0.03)]).tables["errors"].rows
    assert rows == tuple((name, "2.0 %", "3.0 %", "4.0 %", "6.0 %") for name in THESIS_PARAMETERS)


def test_intervals_are_counted_over_arms_and_parameters() -> None:
    *_, inside = record_of([comparison(0.01), comparison(0.03)]).figures
    assert (inside.value, inside.n) == (80.0, 10)


@pytest.mark.parametrize(("errors", "met"), [((0.04, -0.05), True), ((0.04, 0.06), False), ((0.04, -0.06), False)])
def test_the_goal_is_the_worst_error_to_either_side(errors: tuple[float, ...], met: bool) -> None:
    figures = record_of(list(map(comparison, errors))).figures[: len(THESIS_PARAMETERS)]
    assert {figure.is_met for figure in figures} == {met}
    assert all(figure.rival_value == pytest.approx(2 * figure.value) for figure in figures)
