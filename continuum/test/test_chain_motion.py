"""Chains of any length under joint torques: an independent engine of rigid bodies, work, energy, exact derivatives."""

import numpy as np
import pytest
from mujoco_chain import Engine
from scipy.integrate import solve_ivp

from continuum.dynamics.balance import numpy_state_space
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.values import shared_directions

TIGHT = Tolerances(1e-10, 1e-11, 0.01)


def chain(n: int, seed: int = 0) -> Model:
    """A bare chain of random links and drives, in any direction of gravity."""
    random = np.random.default_rng([seed, n])
    length = random.uniform(0.1, 0.4, n)
    parameters = Parameters(
        mass=random.uniform(0.2, 1.0, n),
        inertia=random.uniform(1e-3, 5e-3, n),
        center_of_mass=random.uniform(0.2, 0.8, n) * length,
        link_length=length,
        rotor_inertia=random.uniform(1e-3, 1e-2, n),
        hang_angle=random.uniform(-0.5, 0.5, 1),
    )
    return Model(parameters, inputs=InputKind.JOINT_TORQUES)


def torques(n: int, held: bool = False) -> JointTorques:
    """Random torques of about the weight of what a joint carries."""
    size = 0.3 * np.arange(n, 0, -1)
    values = np.random.default_rng([1, n]).uniform(-size, size, (11, n))
    return JointTorques(np.linspace(0.0, 1.0, 11), values, held)


def start(n: int) -> np.ndarray:
    """Angles and rates."""
    random = np.random.default_rng([2, n])
    return np.concatenate([random.uniform(-0.3, 0.3, n), random.uniform(-0.5, 0.5, n)])


def by_the_engine(model: Model, x: np.ndarray, drive: JointTorques) -> np.ndarray:
    """States at the end of every interval between two rows of torques, (rows - 1, 2 n)."""
    engine, n, found = Engine(model.parameters), model.n_joints, []
    for k, (begin, end) in enumerate(zip(drive.times, drive.times[1:], strict=False)):

        def rates(t: float, x: np.ndarray, k: int = k) -> np.ndarray:
            torque = drive.values[k] if drive.held else drive.at(t)
            return np.concatenate([x[n:], engine.acceleration(x[:n], x[n:], torque)])

        x = solve_ivp(rates, (begin, end), x, method="DOP853", rtol=1e-11, atol=1e-12).y[:, -1]
        found.append(x)
    return np.array(found)


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("n", [1, 2, 7])
def test_a_second_of_motion_is_that_of_an_independent_engine(n: int, held: bool) -> None:
    model, drive = chain(n), torques(n, held)
    found = Simulator(model, TIGHT).run(start(n), drive.times, drive)
    assert found.status is SimulationStatus.COMPLETE
    np.testing.assert_allclose(found.states[1:], by_the_engine(model, start(n), drive), rtol=0, atol=1e-6)


@pytest.mark.parametrize("n", [1, 3])
def test_compiled_rates_are_those_of_the_equations_as_written(n: int) -> None:
    model, random = chain(n, 5), np.random.default_rng(n)
    equations, written = CompiledEquations(model), numpy_state_space(model)
    assert equations.n_inputs == model.n_inputs == n
    for _ in range(5):
        x, u = random.normal(size=2 * n), random.normal(size=n)
        np.testing.assert_allclose(equations.rates(x, u), written(x, u), rtol=1e-9, atol=1e-12)
    with pytest.raises(ValueError, match="inputs"):
        equations.rates(np.zeros(2 * n), np.zeros(n + 1))


def test_derivatives_by_lengths_and_inertias_are_those_of_differences() -> None:
    model, drive, step = chain(3, 7), torques(3), 1e-5
    names = ["link_length", "rotor_inertia", "mass", "center_of_mass"]
    simulator, free = Simulator(model, TIGHT), shared_directions(model, names)
    times = np.array([0.0, 0.2, 0.5])
    sensitivities = simulator.run(start(3), times, drive, free=free).sensitivities
    for column, direction in enumerate(free.T):
        there, back = (
            simulator.run(start(3), times, drive, values=simulator.equations.values + side * step * direction).states
            for side in (1, -1)
        )
        expected = (there - back) / (2 * step)
        np.testing.assert_allclose(
            sensitivities[..., column], expected, rtol=0, atol=1e-5 * max(1, np.abs(expected).max())
        )
