"""Cables whose columns are swapped are refused before minutes are spent on them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from identification_laws import recorded, small_simulator

from continuum.dynamics.tensions import Tensions
from continuum.errors import InvalidValueError
from continuum.recordings.cable_sides import refuse_swapped_cables, side_correlation
from continuum.recordings.recording import Recording

PULLS = Tensions([0.0, 0.6, 1.8, 2.4], [[0, 0], [6, 0], [0, 6], [0, 0]])


@pytest.fixture(scope="module")
def pulled() -> Recording:
    """An arm that cables pull to either side, slowly."""
    return recorded(small_simulator(), (0.0, 0.0), np.random.default_rng(3), seconds=2.4, tensions=PULLS)


def changed(run: Recording, swapped: bool, mirrored: bool, pull: float = 1.0) -> Recording:
    values = pull * PULLS.values[:, :: -1 if swapped else 1]
    return replace(run, theta=-run.theta if mirrored else run.theta, tensions=Tensions(PULLS.times, values))


@pytest.mark.parametrize(("swapped", "mirrored"), [(False, False), (True, False), (False, True), (True, True)])
def test_an_arm_that_bends_away_from_the_cable_that_pulls_is_refused(
    pulled: Recording, swapped: bool, mirrored: bool
) -> None:
    run = changed(pulled, swapped, mirrored)
    if swapped == mirrored:
        refuse_swapped_cables(run)
    else:
        with pytest.raises(InvalidValueError, match=r"run: correlation .* is -0\.9.*swap u1 and u2"):
            refuse_swapped_cables(run)


def test_loose_cables_short_runs_and_a_held_arm_have_no_side(pulled: Recording) -> None:
    opposed = changed(pulled, swapped=True, mirrored=False)
    assert side_correlation(opposed) is not None
    assert side_correlation(replace(opposed, tensions=None)) is None
    assert side_correlation(changed(pulled, swapped=True, mirrored=False, pull=0.1)) is None
    strong = changed(pulled, swapped=True, mirrored=False, pull=4.0)
    for rows, is_short in ((179, True), (180, False)):  # a second and a half
        assert (side_correlation(replace(strong.rows(slice(60, 60 + rows)))) is None) == is_short
    assert side_correlation(replace(opposed, theta=0.3 + 0.01 * opposed.theta)) is None


@pytest.mark.parametrize("frequency", [3.0, 4.0, 5.0, 7.0])
def test_a_swing_against_a_fast_pull_is_no_swapped_cable(frequency: float) -> None:
    """Above its resonance an arm moves against what drives it."""
    times = np.arange(361) / 120
    sway = np.sin(2 * np.pi * frequency * times)
    tensions = Tensions(times, np.stack([8 + 8 * sway, 8 - 8 * sway], axis=1))
    run = Recording("fast", times, np.stack([-0.2 * sway, -0.1 * sway], axis=1), None, tensions)
    assert np.corrcoef(sway, run.theta.mean(axis=1))[0, 1] < -0.9
    refuse_swapped_cables(run)
