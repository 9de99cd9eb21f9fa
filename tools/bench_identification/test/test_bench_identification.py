"""The page of the comparison says what was measured, by the worst case."""

from continuum.identification.free import THESIS_PARAMETERS
from tools.bench_identification.arms import MeasuredArm
from tools.bench_identification.page import Comparison, Diagnosed, goals, page
from tools.bench_identification.two_ways import Answer

TRUTH = dict.fromkeys(THESIS_PARAMETERS, 2.0)


def comparison(seconds: float, error: float) -> Comparison:
    """An arm whose smoothing and swarm are wrong by a relative error and twice that."""
    smoothing, swarm = (dict.fromkeys(TRUTH, 2.0 * (1 + e)) for e in (error, -2 * error))
    return Comparison(MeasuredArm((), TRUTH), Answer(smoothing, 0, seconds), Answer(swarm, 2000, 40.0))


def test_goals_are_judged_by_the_worst_case() -> None:
    compared = [comparison(2.0, 0.01), comparison(11.0, 0.03)]
    reached = [(figure, met) for _, _, figure, met in goals(compared, Diagnosed(100.0, "cause"))]
    assert reached == [("11.0 s", "**missed**"), ("100 s", "met")]
    assert [met for *_, met in goals(compared[:1], Diagnosed(121.0, "cause"))] == ["met", "**missed**"]


def test_errors_are_relative_to_the_truth() -> None:
    written = page([comparison(2.0, 0.01), comparison(2.0, 0.03)], Diagnosed(100.0, "cause"))
    for name in THESIS_PARAMETERS:
        assert f"| {name} | 2.0 % | 3.0 % | 4.0 % | 6.0 % |" in written
