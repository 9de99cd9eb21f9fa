"""Cables whose columns are swapped are told before minutes are spent on them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from identification_laws import recorded, small_simulator

from continuum.arrays import Array
from continuum.dynamics.tensions import Tensions
from continuum.identification.cable_sides import odd_sides
from continuum.identification.recording_checks import Samples, repaired

PULLS = Tensions([0.0, 0.6, 1.8, 2.4], [[0, 0], [6, 0], [0, 6], [0, 0]])


@pytest.fixture(scope="module")
def pulled() -> tuple[Array, Array, Array]:
    """Times, joint angles and tensions of an arm that cables pull to either side, slowly."""
    run = recorded(small_simulator(), (0.0, 0.0), np.random.default_rng(3), seconds=2.4, tensions=PULLS)
    return run.times, run.theta, np.array([PULLS.at(t) for t in run.times])


@pytest.mark.parametrize(("swapped", "mirrored"), [(False, False), (True, False), (False, True), (True, True)])
def test_an_arm_that_bends_away_from_the_cable_that_pulls_is_told(
    pulled: tuple[Array, Array, Array], swapped: bool, mirrored: bool
) -> None:
    times, theta, tensions = pulled
    theta, tensions = (-theta if mirrored else theta), (tensions[:, ::-1] if swapped else tensions)
    samples = Samples(Path("run.csv"), np.arange(times.size), times, theta, None, tensions)
    good, notes = repaired(samples)
    assert any("u1 and u2 swapped" in note for note in notes) == (swapped != mirrored)
    np.testing.assert_array_equal(good.theta, theta)  # told, not mended: nobody knows which of the two is wrong


def test_cells_of_loose_cables_have_no_side(pulled: tuple[Array, Array, Array]) -> None:
    _, theta, tensions = pulled
    assert odd_sides(theta, 0.1 * tensions[:, ::-1]) == []
    assert odd_sides(np.full_like(theta, 0.1), tensions) == []
