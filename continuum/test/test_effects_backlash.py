"""A joint's play, turned to and fro: what it carries where, and that it never gives energy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from dynamics_laws import active, energies, moving, prototype_model
from effects_laws import LOOSE, RELEASED, N, effect_of, extended, resting_state, simulator
from scipy.integrate import solve_ivp

from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.planar.springs_and_friction import break_away_torque, joint_friction, spring_torque

GAP = 0.05
TIMES = np.linspace(0.0, 1.0, 1001)
STOP, CORNER, BALL = 3000.0, 1e-4, 1e-6
"""As the effect's docstring says [N m/rad, rad, kg m2]."""


@dataclass(frozen=True)
class Turned:
    """One joint that is turned, (n_times,) each: where it is, where its link is in the play, and what it carries."""

    p: Parameters
    theta: np.ndarray
    rate: np.ndarray
    y: np.ndarray
    y_rate: np.ndarray
    torque: np.ndarray

    @property
    def ball(self) -> np.ndarray:
        return self.theta - self.y


def turned(amplitudes: np.ndarray, speeds: np.ndarray) -> Turned:
    """theta(t), a sum of sines from rest."""
    p = replace(prototype_model(1).parameters, rest_angle=np.full(1, 0.02))
    one = active(effect_of("backlash"), gap=GAP)

    def now(t: float) -> Instant:
        phase = speeds * t
        ways = amplitudes * np.array([np.sin(phase), speeds * np.cos(phase), -(speeds**2) * np.sin(phase)])
        return Instant(moving(*ways.sum(axis=1)[:, None]), LOOSE, p)

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        left = one.effect.state_balance(now(t), one.values, state, np.zeros(2))
        sensitivities = [one.effect.state_balance(now(t), one.values, state, unit) - left for unit in np.eye(2)]
        return np.linalg.solve(np.transpose(sensitivities), -left)

    start = one.effect.initial_state(np.zeros(1), LOOSE, one.values, p)
    found = solve_ivp(rates, (0.0, TIMES[-1]), start, "BDF", TIMES, rtol=1e-5, atol=1e-7)
    instants = [now(t) for t in TIMES]
    theta, rate = (np.array([getattr(at.motion, name)[0] for at in instants]) for name in ("theta", "theta_rate"))
    added = [one.effect.torque(at, one.values, state)[0] for at, state in zip(instants, found.y.T, strict=True)]
    torque = np.array(added) + spring_torque(theta, p) + joint_friction(rate, p)
    return Turned(p, theta, rate, *found.y, torque)


def test_within_its_play_a_link_meets_nothing_and_beyond_it_the_ball_with_spring_and_friction() -> None:
    run = turned(np.array([0.3]), np.array([2 * np.pi]))
    within = np.abs(run.y) < 0.8 * GAP
    assert 0.02 < np.mean(within) < 0.5
    assert np.abs(run.torque[within]).max() < 0.1 * break_away_torque(run.p)[0]
    for side in (1.0, -1.0):  # driven outwards, the ball goes before the link
        pushed = (side * run.y > GAP) & (side * run.theta > 0.15) & (side * run.rate > 0.3)
        assert np.mean(pushed) > 0.05
        np.testing.assert_allclose(run.ball[pushed], run.theta[pushed] - side * GAP, atol=3e-3)
        carried = spring_torque(run.theta - side * GAP, run.p) + joint_friction(run.rate, run.p)
        np.testing.assert_allclose(run.torque[pushed], carried[pushed], atol=5e-3)


def test_a_ball_that_friction_holds_stays_until_the_link_has_crossed_the_play() -> None:
    """Swings about rest too small for the spring to bring the ball along."""
    run = turned(np.array([1.5 * GAP]), np.array([2 * np.pi]))
    crossing = (TIMES > 0.25) & (TIMES < 0.75) & (np.abs(run.y) < 0.9 * GAP)
    assert np.ptp(run.y[crossing]) > 1.7 * GAP
    assert np.ptp(run.ball[crossing]) < 0.1 * GAP


def test_play_takes_energy_and_never_gives_any() -> None:
    """Of an arm let go: what links, balls, springs and stops hold together only falls."""
    model = extended(prototype_model(N), "backlash", {"gap": GAP})
    p = model.parameters
    run = simulator("backlash").around(model).run(resting_state(model, RELEASED, LOOSE), np.linspace(0, 1.2, 601))
    theta, rate, y, y_rate = (run.states[:, at : at + N] for at in (0, N, 2 * N, 3 * N))
    moved = energies(run.states, prototype_model(N).with_values({"stiffness": 0.0}))

    def rounded(x: np.ndarray) -> np.ndarray:
        return (x * np.hypot(x, CORNER) + CORNER**2 * np.arcsinh(x / CORNER)) / 2

    balls = BALL * (rate - y_rate) ** 2 + p.stiffness * (1 + p.stiffness / STOP) * (theta - y - p.rest_angle) ** 2
    stops = (STOP + p.stiffness) * (y**2 - rounded(y + GAP) + rounded(y - GAP))
    energy = np.sum(moved, axis=0) + np.sum(balls + stops, axis=1) / 2
    assert np.all(np.ptp(y, axis=0) > 1.9 * GAP)
    assert np.diff(energy).max() < 1e-8
    assert energy[0] - energy[-1] > 0.1


def test_a_resting_ball_leans_on_the_stop_that_its_spring_pulls_it_to() -> None:
    p = replace(prototype_model(N).parameters, rest_angle=np.full(N, 0.1))
    one = active(effect_of("backlash"), N, gap=GAP)
    theta = 0.1 + np.array([0.3, 0.02, 0.0, -0.02, -0.3])
    y = one.effect.initial_state(theta, LOOSE, one.values, p)
    np.testing.assert_allclose(y[:N], [GAP, 0.02, 0.0, -0.02, -GAP], atol=2e-3)
    now = Instant(moving(theta, np.zeros(N)), LOOSE, p)
    carried = one.effect.torque(now, one.values, y) + spring_torque(theta, p)
    np.testing.assert_allclose(carried, p.stiffness * [0.25, 0.0, 0.0, 0.0, -0.25], atol=2e-3)
