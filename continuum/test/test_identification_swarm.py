"""The thesis's objective (Eq. 19) and its particle swarm (Table 2)."""

from dataclasses import asdict

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from identification_laws import releases, small_simulator

from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import Reading
from continuum.identification.free import Free, FreeSpace
from continuum.identification.nrmse import measured_rates, nrmse, nrmse_by_joint, rate_nrmse
from continuum.identification.swarm import SwarmSettings, particle_swarm, swarm_identification
from continuum.recordings.recording import Recording

RANDOM = np.random.default_rng(5)
MEASURED = RANDOM.normal(size=(50, 3)) * np.array([1.0, 10.0, 0.1])


def test_equal_signals_differ_by_nothing_and_the_mean_by_one() -> None:
    assert nrmse(MEASURED, MEASURED) == 0.0
    assert nrmse(np.broadcast_to(MEASURED.mean(axis=0), MEASURED.shape), MEASURED) == pytest.approx(1.0)


@given(st.floats(1e-3, 1e3), st.floats(-100, 100))
def test_units_and_zero_do_not_matter(scale: float, shift: float) -> None:
    simulated = MEASURED + 0.3 * np.roll(MEASURED, 1, axis=0)
    moved = nrmse(scale * simulated + shift, scale * MEASURED + shift)
    assert moved == pytest.approx(nrmse(simulated, MEASURED), rel=1e-6)


def test_it_is_the_mean_of_the_joints() -> None:
    simulated = MEASURED + np.array([0.5, 0.0, 0.0]) * np.std(MEASURED, axis=0)
    np.testing.assert_allclose(nrmse_by_joint(simulated, MEASURED), [0.5, 0.0, 0.0], atol=1e-12)
    assert nrmse(simulated, MEASURED) == pytest.approx(0.5 / 3)


def test_joints_that_never_move_do_not_count() -> None:
    still = MEASURED * np.array([1.0, 0.0, 1.0])
    assert nrmse_by_joint(still + 0.1, still).shape == (2,)


def test_rates_that_were_not_measured_are_derivatives_of_the_angles() -> None:
    """Exact for cubics, ends and uneven sampling included."""
    t = np.sort(np.random.default_rng(1).uniform(0, 1, 40))
    cubic = np.stack([1 + 2 * t - t**2 + 3 * t**3, -t], axis=1)
    found = measured_rates(Recording("cubic", t, cubic))
    np.testing.assert_allclose(found, np.stack([2 - 2 * t + 9 * t**2, -np.ones(40)], axis=1), atol=1e-6)
    of_few = measured_rates(Recording("five samples", t[:5], cubic[:5]))
    np.testing.assert_allclose(of_few, found[:5], atol=1e-6)
    rates = np.zeros((40, 2))
    assert measured_rates(Recording("cubic", t, cubic, rates)) is rates


LOWER, UPPER, BEST = np.array([-2.0, -1.0, 0.0]), np.array([1.0, 3.0, 5.0]), np.array([-0.5, 2.0, 1.0])


def test_a_swarm_finds_the_least_of_a_parabola() -> None:
    settings = SwarmSettings(particles=30, iterations=300, constriction=0.3)
    place, lowest = particle_swarm(
        lambda x: float(np.sum((x - BEST) ** 2)), LOWER, UPPER, np.random.default_rng(0), settings
    )
    np.testing.assert_allclose(place, BEST, atol=0.05)
    assert lowest == pytest.approx(np.sum((place - BEST) ** 2))


@pytest.mark.parametrize("seed", range(2))
def test_a_swarm_stays_within_bounds_and_never_gets_worse(seed: int) -> None:
    tried: list[np.ndarray] = []

    def objective(x: np.ndarray) -> float:
        tried.append(x.copy())
        return float(np.sum(x))  # least in a corner

    settings = SwarmSettings(constriction=1.0)  # particles shoot beyond their leader
    place, lowest = particle_swarm(objective, LOWER, UPPER, np.random.default_rng(seed), settings)
    assert np.all((np.array(tried) >= LOWER) & (np.array(tried) <= UPPER))
    assert len(tried) <= settings.particles * (settings.iterations + 1)
    assert lowest == min(float(np.sum(x)) for x in tried)
    assert lowest == np.sum(place)


def test_a_swarm_that_has_met_stops() -> None:
    calls = 0

    def flat(_x: np.ndarray) -> float:
        nonlocal calls
        calls += 1
        return 0.0

    settings = SwarmSettings(variation_tolerance=1e9)
    particle_swarm(flat, LOWER, UPPER, np.random.default_rng(0), settings)
    assert calls == 2 * settings.particles  # the first iteration gains infinitely


TRUTH = {"stiffness": 1.5, "viscous_friction": 0.025}
FREE = [Free("stiffness"), Free("viscous_friction")]


def rate_error(simulator: Simulator, run: Recording, values: np.ndarray) -> float:
    motion = simulator.run(run.theta[0], run.times, run.pull, values)
    return rate_nrmse(Reading(motion.times, motion.theta, motion.theta_rate, 0.0), run)


def test_the_swarm_identifies_and_counts_its_simulations() -> None:
    simulator = small_simulator(None, Tolerances(1e-3, 1e-4, 0.01))
    runs = releases(2, simulator, 11, TRUTH)
    space = FreeSpace(simulator.model, FREE)
    settings = SwarmSettings(particles=8, iterations=6)
    found = swarm_identification(simulator, runs, space, np.random.default_rng(1), settings)
    assert found.simulations == 2 * 8 * (6 + 1)
    again = swarm_identification(simulator, runs, space, np.random.default_rng(1), settings)
    np.testing.assert_array_equal(again.coordinates, found.coordinates)
    at = space.common_values(found.coordinates)
    nominal = np.array([simulator.model.values()[name][0] for name in TRUTH])
    assert np.all(nominal + space.amounts(found.coordinates) <= 3 * nominal)
    assert found.objective == pytest.approx(np.mean([rate_error(simulator, run, at) for run in runs]))


def test_the_settings_are_those_of_table_2() -> None:
    table = {
        "particles": 20, "iterations": 40, "objective_tolerance": 0.001, "variation_tolerance": 0.0001,
        "cognitive": 3.0, "social": 2.0, "momentum": 0.1, "constriction": 0.1146,
    }  # fmt: skip
    assert asdict(SwarmSettings()) == table
