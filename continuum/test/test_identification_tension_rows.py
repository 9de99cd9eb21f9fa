"""Do recorded tensions hold from row to row, as commands do, or change linearly, as measured ones? The data tell."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from identification_laws import BENDS, recorded, small_simulator, white_noise

from continuum.discovery.trial import TOLERANCES
from continuum.dynamics.tensions import Tensions
from continuum.identification.free import Free
from continuum.identification.tension_rows import jumps_tell, with_likelier_rows
from continuum.recordings.recording import Recording

SIMULATOR = small_simulator()
ROUGH = small_simulator(None, TOLERANCES)
"""As exact as diagnoses are."""
FREE = tuple(Free(name) for name in ("stiffness", "viscous_friction", "coulomb_friction"))

STEPS = Tensions(np.arange(0, 0.6, 1 / 30), np.random.default_rng(0).uniform(0, 8, (18, 2)))
"""Rows as a commander sends them, 30 times a second."""


@pytest.mark.parametrize("held", [True, False])
def test_how_tensions_go_on_between_rows_is_told_by_the_data(held: bool) -> None:
    truth = replace(STEPS, held=held)
    random = np.random.default_rng(2)
    driven = recorded(SIMULATOR, BENDS[0], random, tensions=truth)
    free = recorded(SIMULATOR, BENDS[1], random)
    given: list[Recording] = [replace(driven, tensions=replace(STEPS, held=not held)), free]
    found = with_likelier_rows(ROUGH, given, white_noise(), FREE)
    assert found[0].tensions is not None
    assert found[0].tensions.held is held
    assert found[1] is free
    assert with_likelier_rows(ROUGH, [free], white_noise(), FREE) == (free,)


@pytest.mark.parametrize("slope", [3.3, 4.0, 6.0])
def test_a_ramp_is_no_jump(slope: float) -> None:
    """Tensions that change fast and evenly, measured: joints do nothing at once, and half a row still tells."""
    times = np.arange(73) / 120
    up = np.clip(slope * (np.arange(73) - 6), 0, 20 * slope / 3.3)
    tensions = Tensions(times, np.stack([up, np.zeros(73)], axis=1), held=False)
    run = recorded(SIMULATOR, BENDS[0], np.random.default_rng(5), tensions=tensions)
    assert not jumps_tell([run])
    (found,) = with_likelier_rows(ROUGH, [replace(run, tensions=replace(tensions, held=True))], white_noise(), FREE)
    assert found.tensions is not None
    assert not found.tensions.held


def test_a_joint_that_slips_by_chance_beside_a_jump_tells_nothing_of_tensions() -> None:
    """A cable that is late answers later than the row; what joints do just then they have done before as well."""
    times = np.arange(12) / 120
    jolts = 60 * np.array([0, 1, -1, 1, -1, 1, -1, -1, 1, -1, 1])  # [rad/s2], before the jump and after it
    rate = np.zeros((12, 2))
    rate[1:, 0] = np.cumsum(jolts) / 120
    u = np.zeros((12, 2))
    u[:7, 0] = 9.0
    sticking = Recording("late", times, np.zeros((12, 2)), rate, Tensions(times, u))
    (found,) = with_likelier_rows(ROUGH, [sticking], white_noise(), FREE)
    assert found.tensions is not None
    assert found.tensions.held
