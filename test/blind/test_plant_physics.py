"""The plant's mechanics by their laws: energy, virtual work, stiction, convergence."""

from functools import partial

import mujoco
import numpy as np
import pytest

from blind.plant import Machine, Parameters, make_case, prototype
from blind.plant.cable_friction import belt_like_ratio
from blind.plant.effects import EFFECTS
from blind.plant.parameters import GRAVITY

pytestmark = pytest.mark.slow

NOTHING = np.zeros(2)


def rng() -> np.random.Generator:
    return np.random.default_rng(0)


def frictionless() -> Parameters:
    p = prototype().with_(cable_friction=0.0)
    for name in ("coulomb", "viscous"):
        p = p.scaled(name, None, 0.0)
    return p


def placed(p: Parameters, degrees: list[float]) -> Machine:
    machine = Machine(p, (), rng())
    machine.data.qpos[:] = np.radians(degrees)
    return machine


def energy(machine: Machine) -> float:
    """Kinetic, of gravity and of the springs [J], at the instant of the positions."""
    q, v = machine.data.qpos.copy(), machine.data.qvel.copy()
    mujoco.mj_forward(machine.model, machine.data)
    machine.data.qvel[:] = v + 0.5 * machine.dt * machine.data.qacc  # velocities are half a step behind
    mujoco.mj_energyPos(machine.model, machine.data)
    mujoco.mj_energyVel(machine.model, machine.data)
    machine.data.qvel[:] = v
    assert np.array_equal(q, machine.data.qpos)
    return float(machine.data.energy.sum())


def torque_by_virtual_work(angle: np.ndarray, tension: np.ndarray, p: Parameters) -> np.ndarray:
    """-sum_j T_ij dl_ij / dtheta_i by differences of the chords (5,) for tensions (2, 5) [N m]."""
    a, b, h = p.hole_radius, p.half_spacing, 1e-6

    def chords(theta: np.ndarray) -> np.ndarray:
        # hole before the joint at (x, b), hole after it at (x, -b), turned about the joint
        across = np.array([[a], [-a]])
        turned = np.array(
            [across * np.cos(theta) + b * np.sin(theta), across * np.sin(theta) - b * np.cos(theta)]
        ) - np.array([across * np.ones_like(theta), b * np.ones((2, theta.size))])
        return np.hypot(*turned)

    return -np.sum(tension * (chords(angle + h) - chords(angle - h)) / (2 * h), axis=0)


def test_without_friction_energy_stays() -> None:
    machine = placed(frictionless(), [20, 10, 25, -5, 30])
    kept = [energy(machine)]
    for _ in range(20):
        for _ in range(round(0.05 / machine.dt)):
            machine.step(NOTHING)
        kept.append(energy(machine))
    straight = energy(placed(frictionless(), [0] * 5))
    np.testing.assert_allclose(kept, kept[0], atol=2e-3 * (kept[0] - straight))


def test_friction_takes_energy() -> None:
    machine = placed(prototype(), [20, 10, 25, -5, 30])
    before = energy(machine)
    for _ in range(round(0.05 / machine.dt)):
        machine.step(NOTHING)
    assert energy(machine) < before - 1e-3


def test_a_cable_bends_the_arm_to_its_side() -> None:
    for cable, side in ((0, 1), (1, -1)):
        machine = Machine(prototype(), (), rng())
        machine.settle(20.0 * np.eye(2)[cable])
        assert np.all(side * machine.angle > np.radians(2))


def test_cables_torque_is_that_of_virtual_work() -> None:
    p = prototype().with_(cable_friction=0.0)
    machine = placed(p, [20, -10, 25, 5, 30])
    machine.step(np.array([13.0, 4.0]))
    angle = np.radians([20, -10, 25, 5, 30])
    expected = torque_by_virtual_work(angle, np.array([[13.0], [4.0]]) * np.ones(5), p)
    np.testing.assert_allclose(machine.data.qfrc_actuator, expected, atol=1e-8)


def test_cables_torque_is_that_of_virtual_work_with_friction_too() -> None:
    p = prototype()
    machine = Machine(p, (), rng())
    machine.pull_to(np.radians(70))
    before = machine.angle
    machine.step(np.array([20.0, 5.0]))
    of_hinges = np.zeros(5)
    of_hinges[:] = machine.data.efc_force[:5]
    torque = machine.data.qfrc_actuator + machine.data.qfrc_constraint - of_hinges
    np.testing.assert_allclose(torque, torque_by_virtual_work(before, machine.cable_tension(), p), atol=2e-5)


def test_a_sliding_cable_loses_tension_as_a_belt_does() -> None:
    p = prototype()
    machine = Machine(p, (), rng())
    while machine.angle.sum() < np.radians(80):
        machine.step(machine.pulling + np.array([60.0 * machine.dt, 0.0]))
    found = machine.cable_tension()[0] / machine.pulling[0]
    turned = np.cumsum(machine.angle) - machine.angle / 2  # all the way to the middle of each module
    np.testing.assert_allclose(belt_like_ratio(machine.angle, p.cable_friction), np.exp(-0.2 * turned), rtol=1e-3)
    np.testing.assert_allclose(found, belt_like_ratio(machine.angle, p.cable_friction), rtol=0.01)


def test_friction_holds_a_bent_arm_still() -> None:
    bent = [0.5, 0.5, 0.5, 0.5, 0.5]
    held, loose = placed(prototype(), bent), placed(frictionless(), bent)
    for machine in (held, loose):
        for _ in range(round(0.5 / machine.dt)):
            machine.step(NOTHING)
    assert np.abs(np.degrees(held.data.qpos) - bent).max() < 1e-3
    assert np.abs(np.degrees(loose.data.qpos) - bent).max() > 0.1


@pytest.mark.parametrize(("share", "moves"), [(0.96, False), (1.04, True)])
def test_a_joint_breaks_away_at_coulomb_and_stribeck_together(share: float, moves: bool) -> None:
    p = prototype()
    gravity = p.mass[4] * 9.80665 * p.half_spacing
    breaking = np.degrees(p.coulomb[4] * (1 + p.stribeck[4]) / (p.stiffness[4] + gravity))
    machine = placed(p, [0, 0, 0, 0, share * breaking])
    machine.settle(NOTHING)
    assert (np.degrees(machine.data.qpos[4]) < share * breaking - 0.1) == moves


def test_a_pulled_arm_stays_while_tension_changes_little() -> None:
    machine = Machine(prototype(), (), rng())
    command = machine.pull_to(np.radians(60))
    before = machine.data.qpos.copy()
    machine.settle(0.97 * command)
    assert np.abs(np.degrees(machine.data.qpos - before)).max() < 2e-3
    machine.settle(0.3 * command)
    assert np.abs(np.degrees(machine.data.qpos - before)).max() > 2


@pytest.mark.parametrize("regime", ["release", "multisine"])
def test_half_the_step_changes_little(regime: str) -> None:
    measure = partial(make_case, dataset=[regime], seed=5, seconds=1.5)
    coarse, fine = (measure(steps=steps).without_noise["run_1.csv"] for steps in (64, 128))
    assert np.degrees(np.abs(coarse - fine)).max() < 0.02


def test_gravity_pulls_a_tilted_arm_to_the_plumb_line() -> None:
    machine = Machine(frictionless().with_(base_tilt=0.1), (), rng())
    np.testing.assert_array_less(machine.data.qfrc_bias * -1, 0)  # torque of gravity is minus the bias


@pytest.mark.parametrize("pull", [0.0, 9.0])
def test_a_loaded_joint_rubs_by_what_it_carries(pull: float) -> None:
    """Straight and still, between two cables: the weight beyond the joint less what both cables press it together."""
    p = prototype()
    machine = Machine(p, [EFFECTS["load_friction"](1e-3)], rng())
    for _ in range(3):
        machine.step(np.full(2, pull))
    weight = GRAVITY * np.cumsum(p.mass[::-1])[::-1]
    grown = machine.coulomb - p.coulomb * (1 + p.stribeck)
    assert grown == pytest.approx(1e-3 * np.abs(weight - 2 * pull), rel=1e-3)
