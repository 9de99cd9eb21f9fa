"""An arm simulated interval by interval is the arm simulated in one go; its cables are those of the kinematics."""

from itertools import pairwise

import numpy as np
import pytest
from dynamics_laws import LaggingDrive, active, random_model

from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.live.live_arm import INTEGRATORS, LiveArm
from continuum.dynamics.live.stepper import Interval
from continuum.dynamics.model_file import load_model
from continuum.dynamics.planar.cable_lengths import SIDES, chord_lengths
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import InvalidValueError

pytestmark = pytest.mark.slow

MODEL = load_model("lamecc_prototype.yaml")
TICK = 1 / 120
SLACK = np.zeros(len(SIDES))
START = np.radians([10.0, 14.0, 18.0, 20.0, 24.0])


def pulled(n: int) -> np.ndarray:
    """Tensions at ``n`` instants, one cable after the other, with a kink at each, (n, 2) [N]."""
    wave = 15 * np.sin(2 * np.pi * 0.8 * TICK * np.arange(n)) + np.random.default_rng(1).uniform(-1, 1, n)
    return np.stack([np.maximum(wave, 0), np.maximum(-wave, 0)], axis=1)


def driven(arm: LiveArm, tensions: np.ndarray) -> np.ndarray:
    states = [arm.state]
    for before, after in pairwise(tensions):
        assert arm.advance(Interval(TICK, before, after)) is SimulationStatus.COMPLETE
        states.append(arm.state)
    return np.array(states)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("tensions", [pulled(120), np.zeros((120, 2))], ids=["driven", "released"])
def test_intervals_add_up_to_one_simulation(integrator, tensions):
    times = TICK * np.arange(len(tensions))
    converged = Simulator(MODEL, Tolerances(1e-9, 1e-10, 1e-3)).run(START, times, Tensions(times, tensions)).theta
    live = driven(LiveArm(MODEL, START, integrator), tensions)[:, : MODEL.n_joints]
    assert np.degrees(np.abs(live - converged).max()) < 0.05


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_jump_begins_again(integrator):
    """What was before a posture is set, or a cable is cut, leaves no trace."""
    arm = LiveArm(MODEL, START, integrator)
    driven(arm, pulled(30))
    arm.place(-START)
    after_reset = driven(arm, np.zeros((10, 2)))
    np.testing.assert_array_equal(after_reset, driven(LiveArm(MODEL, -START, integrator), np.zeros((10, 2))))
    held = np.full((10, 2), [12.0, 0.0])
    arm.place(START)
    at_cut = driven(arm, held)[-1]
    cut = driven(arm, np.zeros((10, 2)))
    np.testing.assert_array_equal(cut, driven(LiveArm(MODEL, at_cut, integrator), np.zeros((10, 2))))


def test_cable_rates_are_derivatives_of_their_lengths():
    arm = LiveArm(MODEL, START)
    np.testing.assert_allclose(arm.cable_lengths, chord_lengths(START, MODEL.parameters).sum(axis=0), rtol=1e-12)
    arm.place(np.concatenate([START, [0.3, -0.2, 1.0, 0.0, 2.0]]))
    rates, before, step = arm.cable_rates, arm.cable_lengths, 1e-7
    arm.place(arm.angles + step * arm.rates)
    np.testing.assert_allclose((arm.cable_lengths - before) / step, rates, rtol=1e-5)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_tension_beyond_all_numbers_leaves_the_arm_where_it_is(integrator):
    arm = LiveArm(MODEL, START, integrator)
    status = arm.advance(Interval(TICK, SLACK, np.array([1e300, 0.0])))
    assert status is not SimulationStatus.COMPLETE
    np.testing.assert_array_equal(arm.angles, START)
    driven(arm, np.zeros((5, 2)))


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_effects_with_states_go_along(integrator):
    """A drive that lags goes for 2 N and 1 N by itself; its state moves on with the arm's, and a reset forgets it."""
    arm = LiveArm(random_model(7, 3, (active(LaggingDrive(), lag=0.3),)), np.zeros(3), integrator)
    lagging = driven(arm, np.zeros((13, 2)))[-1]
    np.testing.assert_allclose(lagging[6:], (1 - np.exp(-0.1 / 0.3)) * np.array([2.0, 1.0]), atol=1e-3)
    arm.place(np.zeros(3))
    np.testing.assert_array_equal(driven(arm, np.zeros((13, 2)))[-1], lagging)


def test_a_model_that_cannot_move_is_refused():
    massless = MODEL.with_values({"inertia": 0.0, "center_of_mass": 0.0})
    with pytest.raises(InvalidValueError, match="no finite solution"):
        LiveArm(massless, START, "esdirk")


def test_unknown_integrator_and_wrong_posture():
    with pytest.raises(InvalidValueError, match="integrator is 'euler'; allowed: one of bdf, esdirk"):
        LiveArm(MODEL, START, "euler")
    with pytest.raises(InvalidValueError, match="5 joint angles"):
        LiveArm(MODEL, [0.1, 0.2])
    with pytest.raises(InvalidValueError, match="finite"):
        LiveArm(MODEL, [np.nan] * 5)
