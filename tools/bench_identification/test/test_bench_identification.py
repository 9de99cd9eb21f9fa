"""The page of the comparison says what was measured."""

from continuum.identification.free import THESIS_PARAMETERS
from tools.bench_identification.answers import Answer
from tools.bench_identification.page import Comparison, goals, page


def comparison(error: float) -> Comparison:
    """A fit that is off by a relative error, one of five intervals missing the truth, and a swarm twice as far off."""
    return Comparison(
        Answer((error,) * 5, (True, True, False, True, True), 0.05, 8.0), Answer((-2 * error,) * 5, None, 0.3, 30.0)
    )


def test_errors_are_medians_and_worst_without_sign() -> None:
    written = page([comparison(0.01), comparison(-0.03)])
    for name in THESIS_PARAMETERS:
        assert f"| {name} | 2.0 % | 3.0 % | 4.0 % | 6.0 % |" in written


def test_intervals_are_counted_over_arms_and_parameters() -> None:
    assert "8 of 10" in page([comparison(0.01), comparison(0.03)])


def test_the_goal_is_an_error_to_either_side() -> None:
    assert all("in 1 of 3 arms" in line for line in goals([comparison(0.04), comparison(0.06), comparison(-0.06)]))
