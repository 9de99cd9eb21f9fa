"""Each goal is judged by the worst row that it is of, and by no other."""

import pytest

from tools.benchmarks.ik.figures import FABRIKC, RivalRow, Row, record_of
from tools.benchmarks.ik.scores import Helix, Score

SLOW = {"median": 1e3, "p99": 1e4}


def score(solved: float = 1.0, median: float = 9.0, p99: float = 90.0) -> Score:
    return Score(solved, 1000, median, p99, 3, 5)


def met(*rows: Row, helix: float = 9.0) -> list[bool | None]:
    good = [Row(n, bend, "straight", 1e-6, score()) for n in (3, 7) for bend in (90, 180)]
    rivals = [RivalRow(3, bend, FABRIKC, score(solved=0.7)) for bend in (90, 180)]
    record = record_of([*good, *rows], rivals, Helix(score(median=helix), score(), 1e-9), {})
    return [figure.is_met for figure in record.figures[:5]]


@pytest.mark.parametrize(
    ("row", "missed"),
    [
        (Row(3, 180, "straight", 1e-6, score(solved=0.9999)), None),
        (Row(3, 180, "straight", 1e-4, score(solved=0.5, **SLOW)), None),  # no goal is of this tolerance
        (Row(7, 180, "random", 1e-6, score(**SLOW)), None),  # nor of the times of seven sections
        (Row(7, 90, "random", 1e-6, score(solved=0.99999)), 0),
        (Row(3, 180, "straight", 1e-6, score(solved=0.9998)), 1),
        (Row(3, 180, "random", 1e-6, score(median=41)), 2),
        (Row(3, 90, "random", 1e-6, score(p99=401)), 3),
    ],
)
def test_a_row_misses_the_goal_that_it_is_of_alone(row: Row, missed: int | None) -> None:
    assert met(row) == [number != missed for number in range(5)]


def test_the_helix_has_a_goal() -> None:
    assert met(helix=11.0) == [True] * 4 + [False]
