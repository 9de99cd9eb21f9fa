"""The table of goals says of each whether the worst row met it."""

from tools.bench_ik.__main__ import Goals
from tools.bench_ik.scores import Score


def score(solved: float = 1.0, median: float = 9.0, p99: float = 90.0) -> Score:
    return Score(solved, 1000, median, p99, 3, 5)


def verdicts(goals: Goals, helix: Score) -> list[str]:
    return [line.split("|")[-2].strip() for line in goals.lines(helix)[2:]]


def test_what_is_reached_is_met_and_what_is_not_is_missed() -> None:
    goals = Goals()
    goals.note(3, 90, 1e-6, score())
    goals.note(3, 180, 1e-6, score(solved=0.9999))
    assert verdicts(goals, score()) == ["met"] * 5
    goals.note(3, 180, 1e-4, score(solved=0.5, median=1e3, p99=1e4))  # no goal is of this tolerance
    goals.note(7, 90, 1e-6, score(solved=0.99999, median=1e3, p99=1e4))
    assert verdicts(goals, score()) == ["**missed**", *["met"] * 4]
    goals.note(3, 180, 1e-6, score(solved=0.999, median=41, p99=401))
    assert verdicts(goals, score(median=11.0)) == ["**missed**"] * 5
