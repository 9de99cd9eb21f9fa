"""Holds of arms that another mechanics moves: each is counted once, and nearly all intervals hold the truth."""

from functools import lru_cache

import numpy as np
import pytest

from continuum.dynamics.model_file import load_model
from tools.benchmarks.curvature.__main__ import rows_of
from tools.benchmarks.curvature.plant_holds import KnownHold, known_holds

pytestmark = pytest.mark.slow

HOLDS = 40
"""The benchmark has 200, and measures how often intervals hold the truth."""


@lru_cache
def holds() -> tuple[KnownHold, ...]:
    return tuple(known_holds("Moreau", load_model("lamecc_prototype.yaml"), HOLDS))


def test_most_intervals_hold_the_true_angles() -> None:
    assert len(holds()) == HOLDS
    assert np.mean([hold.inside for hold in holds()]) > 0.90


def test_the_table_counts_every_hold_once() -> None:
    every, *levels, released = rows_of("Moreau", holds())
    assert sum(int(row[1]) for row in levels) == int(every[1]) == HOLDS
    assert all(sum(map(int, row[4:])) == int(row[1]) for row in (every, *levels, released))
