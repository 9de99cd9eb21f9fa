"""Energy along simulated trajectories, and the symmetries of the arm."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
import pytest
from dynamics_laws import FRICTIONLESS, energies, random_model

from continuum.dynamics.integration.esdirk_tableau import fourth_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.dynamics.values import parameter_vector

N = 5
TIMES = np.linspace(0.0, 2.0, 101)


@lru_cache
def simulator(relative: float) -> Simulator:
    return Simulator(random_model(1, N), Tolerances(relative, relative / 10, 0.05), fourth_order())


def simulate(
    model: Model,
    initial: np.ndarray,
    tensions: Tensions | None = None,
    relative: float = 1e-9,
    times: np.ndarray = TIMES,
) -> Trajectory:
    """By the one compiled set of equations with this model's values."""
    found = simulator(relative).run(initial, times, tensions, parameter_vector(model))
    assert found.status is SimulationStatus.COMPLETE
    return found


def random_start(seed: int) -> np.ndarray:
    random = np.random.default_rng(seed)
    return np.concatenate([random.uniform(-0.4, 0.4, N), random.normal(size=N)])


@pytest.mark.parametrize("seed", [2, 3])
def test_energy_is_conserved_without_friction_and_input(seed: int) -> None:
    model = random_model(seed, N).with_values(FRICTIONLESS)
    kinetic, potential = energies(simulate(model, random_start(seed)).states, model)
    assert kinetic.max() - kinetic.min() > 0.01  # it does move
    np.testing.assert_allclose(kinetic + potential, kinetic[0] + potential[0], rtol=0, atol=1e-6 * kinetic.max())


@pytest.mark.parametrize("only", [{"viscous_friction": 0.0}, {"coulomb_friction": 0.0}, {}])
def test_energy_never_rises_with_friction(only: Mapping[str, float]) -> None:
    model = random_model(4, N).with_values(only)
    energy = np.sum(energies(simulate(model, random_start(4)).states, model), axis=0)
    assert energy[0] - energy[-1] > 0.01
    assert np.all(np.diff(energy) <= 1e-8)


PULLS = Tensions(np.array([0.0, 0.2, 0.5, 0.8]), np.array([[0.0, 5.0], [20.0, 0.0], [3.0, 8.0], [0.0, 25.0]]))
SHORT = np.linspace(0.0, 0.8, 41)


def test_a_mirrored_start_with_swapped_tensions_moves_as_the_mirror_image() -> None:
    model, start = random_model(6, N), random_start(6)
    p = model.parameters
    mirrored = model.with_values({"rest_angle": -p.rest_angle, "hang_angle": -p.hang_angle})
    found = simulate(model, start, PULLS, times=SHORT)
    image = simulate(mirrored, -start, Tensions(PULLS.times, PULLS.values[:, ::-1]), times=SHORT)
    np.testing.assert_allclose(image.states, -found.states, rtol=0, atol=1e-8)
    assert np.ptp(found.theta) > 0.2


def test_power_of_the_cables_is_the_gain_of_energy() -> None:
    """Without any friction, energy gained is tension times length taken in."""
    model = random_model(9, N).with_values(FRICTIONLESS | {"capstan_friction": 0.0})
    u = np.array([15.0, 4.0])
    found = simulate(model, random_start(9), Tensions(np.zeros(1), u[None]), times=SHORT)
    energy = np.sum(energies(found.states, model), axis=0)
    b, a = model.parameters.half_spacing, model.parameters.hole_radius
    half = found.theta / 2
    lengths = np.stack([2 * np.sum(b * np.cos(half) - side * a * np.sin(half), axis=1) for side in (1, -1)], axis=1)
    np.testing.assert_allclose(energy - energy[0], (lengths[0] - lengths) @ u, rtol=0, atol=1e-7)
