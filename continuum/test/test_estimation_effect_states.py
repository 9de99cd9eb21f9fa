"""Torque of effects with states along a motion against simulations of arms that have them."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from dynamics_laws import prototype_model
from effects_laws import sized
from estimation_arm import N, drawn_motion, drawn_values, run_over, scene_along, structure

from continuum.dynamics.integration.esdirk_tableau import fourth_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.values import parameter_vector, with_vector
from continuum.estimation.columns import Difference, StatefulTorque
from continuum.estimation.effect_states import SubstepMotion

pytestmark = pytest.mark.slow

STATEFUL = list(structure().stateful)
INTEGRATED = [name for name in STATEFUL if name != "backlash"]
RELEASED = np.radians([18.0, 15.0, -12.0])
DURATION = 0.32
PULLS = Tensions([0.0, 0.1, 0.16, 0.24, 0.4], [[0.0, 0.0], [0.0, 0.0], [9.0, 1.0], [2.0, 8.0], [2.0, 8.0]])
AROUND = 1e-5  # s: rates so far apart tell an acceleration


def prototype(**changed: float) -> np.ndarray:
    """Values of the prototype without effects."""
    params, values = parameter_vector(prototype_model(N)), structure().values.copy()
    values[: params.size] = params
    for name, value in changed.items():
        values[structure().slots[name]] = value
    return values


def values_of(name: str, times_typical: float) -> dict[str, np.ndarray]:
    """The effect's parameters at a multiple of their typical sizes."""
    spec = structure().stateful[name].effect.parameters
    return {key: spec[key].array(value, N, key) for key, value in sized(name, times_typical).items()}


@lru_cache
def simulator(name: str) -> Simulator:
    effect = structure().stateful[name].effect
    model = replace(structure().model, effects=(*structure().model.effects, ActiveEffect(effect, values_of(name, 1.0))))
    return Simulator(model, Tolerances(1e-8, 1e-9, 5e-4), fourth_order())


def simulated(name: str, params: dict[str, np.ndarray], values: np.ndarray, step: float) -> SubstepMotion:
    """Motion of an arm that has the effect, amid substeps of one length, from a release on."""
    base = with_vector(structure().model, values)
    effect = structure().stateful[name].effect
    model = Model(base.parameters, (*base.effects, ActiveEffect(effect, params)))
    first = effect.initial_state(RELEASED, PULLS.at(0.0), params, model.changed_parameters)
    middle = np.arange(step / 2, DURATION, step)
    times = (middle[:, None] + np.array([-AROUND, 0.0, AROUND])).ravel()
    x = np.concatenate([RELEASED, np.zeros(N), np.asarray(first, dtype=float)])
    output = simulator(name).around(model).run(x, np.concatenate([[0.0], times]), PULLS)
    assert output.status is SimulationStatus.COMPLETE
    theta, rate = output.theta[2::3], output.theta_rate[2::3]
    acceleration = (output.theta_rate[3::3] - output.theta_rate[1::3]) / (2 * AROUND)
    run = replace(run_over(step * np.arange(middle.size + 1)), signal=(PULLS.times, PULLS.values), held=False)
    motion = np.stack([theta, rate, acceleration], axis=1)
    return SubstepMotion(motion, rate.copy(), run.inputs, np.full(middle.size, step))


def torques_of(
    name: str, params: dict[str, np.ndarray], values: np.ndarray, step: float
) -> tuple[np.ndarray, np.ndarray]:
    """What the column says that the effect adds, and what Eq. 12 without it misses less of that arm's motion."""
    scene = scene_along(simulated(name, params, values, step), values)
    return StatefulTorque(name, params).torque(scene)[:, :, 0], -scene.nominal()


@pytest.mark.parametrize("name", INTEGRATED)
def test_torque_along_a_motion_is_what_a_simulation_with_the_effect_had(name: str) -> None:
    """As substeps shrink: implicit Euler steps err in proportion to their length.

    Without dry friction where the base gives way: the least error turns that of a joint that sticks to it round.
    """
    values = prototype(**({"coulomb_friction": 0.0} if name == "base_compliance" else {}))
    missed = []
    for step in (2e-3, 5e-4):
        found, expected = torques_of(name, values_of(name, 1.0), values, step)
        missed.append(float(np.linalg.norm(found - expected) / np.linalg.norm(expected)))
    assert missed[1] < 0.15
    assert missed[1] < missed[0] / 2


def test_backlash_of_hard_stops_is_nearly_that_of_the_simulation() -> None:
    """Most of the time: not while a ball with its own inertia knocks at stops that give way, or creeps at rest."""
    found, expected = torques_of("backlash", values_of("backlash", 3.0), prototype(), 1e-3)
    size = np.sqrt(np.mean(expected**2))
    assert np.mean(np.abs(found - expected) < 0.1 * size) > 0.7
    assert np.linalg.norm(found - expected) < 0.6 * np.linalg.norm(expected)


@pytest.mark.parametrize("times_typical", [0.3, 1.0])
def test_backlash_along_a_motion_is_its_effect_s_own(times_typical: float) -> None:
    """Which stands on the left of Eq. 12, as all torques that resist."""
    random = np.random.default_rng(0)
    values, along, params = drawn_values(random), drawn_motion(random, 30), values_of("backlash", times_typical)
    p = with_vector(structure().model, values).changed_parameters
    expected = -structure().stateful["backlash"].effect.torque_along(along.motion, along.slip, along.length, params, p)
    assert np.any(expected)
    np.testing.assert_array_equal(
        StatefulTorque("backlash", params).torque(scene_along(along, values))[:, :, 0], expected
    )


@pytest.mark.parametrize("name", STATEFUL)
def test_joints_have_columns_of_their_own_that_add_up(name: str) -> None:
    random = np.random.default_rng(0)
    scene, params = scene_along(drawn_motion(random, 10), prototype()), values_of(name, 1.0)
    whole, apart = StatefulTorque(name, params).torque(scene), StatefulTorque(name, params, (0, 1, 2)).torque(scene)
    np.testing.assert_array_equal(apart.sum(axis=2), whole[:, :, 0])
    for joint in range(N):
        np.testing.assert_array_equal(np.delete(apart[:, :, joint], joint, axis=1), 0.0)
    one = StatefulTorque(name, params, (1,)).torque(scene)
    np.testing.assert_array_equal(one[:, :, 0], apart[:, :, 1])


@pytest.mark.parametrize("name", ["actuator_lag", "elastic_cable"])
def test_half_the_difference_of_neighbours_tends_to_the_derivative_by_the_logarithm(name: str) -> None:
    """Off by the square of their distance: what a Gauss-Newton step is made of, where states have no corners."""
    scene = scene_along(simulated(name, values_of(name, 1.0), prototype(), 2e-3), prototype())
    size = next(iter(structure().stateful[name].effect.parameters))
    params = values_of(name, 1.0)

    def near(ratio: float) -> list[StatefulTorque]:
        return [StatefulTorque(name, {**params, size: params[size] * factor}) for factor in (ratio, 1 / ratio)]

    above, below = (column.torque(scene) for column in near(1.01))
    exact = (above - below) / np.log(1.01**2)
    off, far_off = (
        np.linalg.norm(Difference(*near(ratio)).torque(scene) / np.log(ratio) - exact) / np.linalg.norm(exact)
        for ratio in (1.1, 1.21)
    )
    assert off < 0.05
    np.testing.assert_allclose(far_off, 4 * off, rtol=0.2)
