"""Friction, drag and springs beyond Eq. 12: work, forces, and the limits in which they are something known."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import active, moving, prototype_model
from effects_laws import LOOSE, N, effect_of, instants, torque_of
from scipy.integrate import solve_ivp

from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.springs_and_friction import break_away_torque, dry_friction, joint_friction
from continuum.effects._parts import joint_force

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("load_friction", {"radius": 0.01}),
        ("quadratic_drag", {"drag": 2.0}),
        ("sensor_cable", {"stiffness": 0.0, "viscous": 0.02, "dry": 0.03}),
        ("sensor_cable", {"viscous": 0.02, "dry": 0.03, "lever": 4.0}),
    ],
)
def test_what_only_takes_energy_never_gives_any(name: str, values: dict[str, float]) -> None:
    taken = [torque_of(name, now, **values) @ now.motion.theta_rate for now in instants(3, 200, np.array([8.0, 3.0]))]
    assert min(taken) >= 0
    assert max(taken) > 1e-3


@pytest.mark.parametrize("changed", [{"viscous": -1.0, "coulomb": 4.0}, {"viscous": 3.0, "coulomb": -1.0}])
def test_changed_joint_friction_takes_energy_still(changed: dict[str, float]) -> None:
    one = active(effect_of("joint_friction"), N, **changed)
    for now in instants(4):
        p, w = one.effect.change_parameters(now.p, one.values), now.motion.theta_rate
        assert np.all(joint_friction(w, p) * w >= 0)


def test_drag_takes_the_power_of_each_links_speed_across() -> None:
    for now in instants(5):
        move, p = now.motion, now.p

        def discs(theta: np.ndarray, p: Parameters = p) -> np.ndarray:
            phi = np.cumsum(theta)
            side = np.stack([np.sin(phi), np.cos(phi)], axis=1)
            steps = p.joint_spacing[:, None] * side
            return np.cumsum(steps, axis=0) - steps + p.half_spacing[:, None] * side

        velocity = np.einsum("ijk,k->ij", differences(discs, move.theta), move.theta_rate)
        across = np.cos(move.link_angle) * velocity[:, 0] - np.sin(move.link_angle) * velocity[:, 1]
        power = np.sum(0.7 * across**2 * np.sqrt(across**2 + 1e-6))
        assert torque_of("quadratic_drag", now, drag=0.7) @ move.theta_rate == pytest.approx(power, rel=1e-6)


def test_a_joint_carries_what_its_links_need() -> None:
    """Newton's law of the mass beyond, at joint rates that do not change, and the cables' pull on it."""
    pull = np.array([8.0, 3.0])
    for now in instants(6, 8):
        move, p = now.motion, replace(now.p, capstan_friction=np.zeros(1))

        def masses(t: np.ndarray, move=move, p=p) -> np.ndarray:
            phi = np.cumsum(move.theta + t * move.theta_rate)
            side = np.stack([np.sin(phi), np.cos(phi)], axis=1)
            steps = p.joint_spacing[:, None] * side
            return np.cumsum(steps, axis=0) - steps + p.center_of_mass[:, None] * side

        second = differences(lambda t: differences(masses, t, 1e-3)[..., 0], [0.0], 1e-3)[..., 0]
        down = p.gravity * np.array([-np.sin(p.hang_angle[0]), np.cos(p.hang_angle[0])])
        needed = np.cumsum((p.mass[:, None] * (second - down))[::-1], axis=0)[::-1]
        np.testing.assert_allclose(joint_force(replace(now, p=p)), needed, rtol=1e-5, atol=1e-4)
        half = np.cumsum(move.theta) - move.theta / 2
        pressed = joint_force(replace(now, u=pull, p=p)) - joint_force(replace(now, p=p))
        np.testing.assert_allclose(pressed, 11.0 * np.stack([np.sin(half), np.cos(half)], axis=1), atol=1e-12)


def test_a_cubic_spring_and_a_sensor_cable_where_they_act() -> None:
    theta, w = np.array([0.3, -0.2, 0.1, 0.0, 0.4]), np.array([2.0, 1.0, 0.0, -1.0, 0.0])
    now = Instant(moving(theta, w), LOOSE, replace(prototype_model(N).parameters, rest_angle=np.full(N, 0.1)))
    np.testing.assert_allclose(torque_of("hardening_spring", now, cubic=3.0), 3 * (theta - 0.1) ** 3)
    held = torque_of("sensor_cable", now, preload=-0.04, stiffness=0.5, viscous=0.1, dry=0.03)
    np.testing.assert_allclose(held, [-0.04 + 0.5 * 0.3 + 0.1 * 2.0 + 0.03, 0, 0, 0, 0])


def test_a_sensor_cable_that_is_drawn_straight_pulls_by_its_lever() -> None:
    """Against a long one from a clamp across the arm: tension times the slope of its length, to first order of it."""
    lateral, beyond, force, k, dry, length = 0.04, 0.02, 0.5, 20.0, 0.2, 5.0

    def stretched(q: np.ndarray) -> np.ndarray:
        across = beyond * np.sin(q) - lateral * np.cos(q) + lateral
        along = -beyond * np.cos(q) - lateral * np.sin(q) + beyond
        return np.hypot(length + across, along) - length

    values = {"preload": force * beyond, "stiffness": k * beyond**2, "dry": dry * beyond, "lever": lateral / beyond}
    for theta in (-0.1, -0.02, 0.05, 0.1):
        now = Instant(moving(np.full(N, theta), np.full(N, 1.0)), LOOSE, prototype_model(N).parameters)
        lever = differences(stretched, np.array([theta]), 1e-3)[0, 0]
        expected = lever * (force + k * stretched(np.array([theta]))[0] + dry)
        assert torque_of("sensor_cable", now, **values)[0] == pytest.approx(expected, rel=0.02)


def test_what_the_load_adds_has_a_stribeck_part_of_its_own() -> None:
    p = replace(prototype_model(N).parameters, stribeck_gain=np.full(N, 0.7))
    slow, fast = (Instant(moving(np.zeros(N), np.full(N, w)), LOOSE, p) for w in (0.02, 50.0))
    first, last = (torque_of("load_friction", now, radius=0.01, stribeck=0.5)[-1] for now in (slow, fast))
    plain = torque_of("load_friction", slow, radius=0.01)[-1]
    assert first == pytest.approx(1.5 * plain, rel=0.01)
    assert last > plain  # its own motion presses it, and no Stribeck part


SPREAD = 0.7
ANGLES = 1 + SPREAD * np.array([-2.0, 0.0, 2.0]) / 3
"""Of the elements of `presliding`, in units of sigma: as its docstring says."""


def slid(turn: Callable[[float], float], times: np.ndarray, angle: float) -> tuple[np.ndarray, np.ndarray]:
    """Of one joint that turns at a given rate: friction over tau_c (n_times,), and states (n_times, 3)."""
    p = prototype_model(1).parameters
    one = active(effect_of("presliding"), angle=angle, spread=SPREAD)

    def at(t: float) -> Instant:
        return Instant(moving(np.zeros(1), np.array([turn(t)])), LOOSE, p)

    def rates(t: float, s: np.ndarray) -> np.ndarray:
        still = one.effect.state_balance(at(t), one.values, s, np.zeros(3))
        return -still / (one.effect.state_balance(at(t), one.values, s, np.ones(3)) - still)

    found = solve_ivp(rates, (times[0], times[-1]), np.zeros(3), "BDF", times, rtol=1e-9, atol=1e-10, max_step=0.01)
    held = []
    for t, s in zip(times, found.y.T, strict=True):
        w = at(t).motion.theta_rate
        without = dry_friction(w, p) * np.tanh(p.friction_slope * w)
        held.append((one.effect.torque(at(t), one.values, s) + without)[0] / p.coulomb_friction[0])
    return np.array(held), found.y.T


def test_sliding_steadily_the_friction_is_that_of_eq_13() -> None:
    p = prototype_model(1).parameters
    for w in (-3.0, -0.05, 0.03, 0.3, 2.0):
        held, _ = slid(lambda t, w=w: w, np.array([0.0, 0.5 / abs(w)]), 0.02)
        expected = dry_friction(np.array([w]), p)[0] * np.sign(w) / p.coulomb_friction[0]
        assert held[-1] == pytest.approx(expected, abs=1e-6)


def test_a_creeping_joint_meets_no_more_than_the_break_away_torque() -> None:
    p = prototype_model(1).parameters
    held, _ = slid(lambda t: 5e-3, np.linspace(0.0, 40.0, 101), 0.02)
    most = break_away_torque(p)[0] / p.coulomb_friction[0]
    assert 0.9 * most < held.max() <= most * (1 + 1e-6)


def test_a_stuck_joint_is_a_spring_at_first_and_loses_at_every_turn() -> None:
    angle, times = 0.02, np.linspace(0, 1, 1001)
    turn = 1.5 * angle * 2 * np.pi
    held, _ = slid(lambda t: turn * np.cos(2 * np.pi * t), times, angle)
    way = turn / (2 * np.pi) * np.sin(2 * np.pi * times)
    assert held[20] == pytest.approx(way[20] / angle, rel=0.06)
    assert np.trapezoid(held * turn * np.cos(2 * np.pi * times), times) > 0.1 * angle
    assert abs(held[500]) > 0.1  # back where it began, but not the friction


def test_a_small_turn_back_and_forth_is_forgotten() -> None:
    """Its loop closes: where the joint turned back, friction is what it was, and goes on as if nothing had been."""
    angle, speed = 0.02, 0.05
    ends = np.cumsum([0.5, 0.15, 0.15, 0.2])
    there_and_back = lambda t: speed * (-1.0 if ends[0] <= t < ends[1] else 1.0)  # noqa: E731
    with_turn, _ = slid(there_and_back, np.concatenate([[0.0], ends]), angle)
    straight, _ = slid(lambda t: speed, np.array([0.0, ends[0], ends[0] + 0.2]), angle)
    assert with_turn[2] < 0.8 * with_turn[1]
    assert with_turn[3] == pytest.approx(straight[1], rel=0.02)
    assert with_turn[4] == pytest.approx(straight[2], rel=0.02)


def test_presliding_friction_stores_and_takes_but_never_makes_energy() -> None:
    random, angle, times = np.random.default_rng(8), 0.02, np.linspace(0, 1, 4001)
    a, b = random.normal(size=6), random.uniform(2, 40, 6)

    def turn(t: float) -> float:
        return float(np.sum(a * np.sin(b * t)))

    held, s = slid(turn, times, angle)
    power = held * np.array([turn(t) for t in times])
    work = np.concatenate([[0.0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(times))])
    lost = work - (angle + 1e-5) * s**2 @ ANGLES**2 / 6
    assert np.diff(lost).min() > -1e-5
    assert lost[-1] > 0.1
