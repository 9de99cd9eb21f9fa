"""A joint's play, turned to and fro: what it carries where, and that it never gives energy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from dynamics_laws import active, moving, prototype_model
from effects_laws import LOOSE, effect_of
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.eq12_spring_torque import spring_torque
from continuum.dynamics.planar.eq13_joint_friction import break_away_torque, joint_friction
from continuum.dynamics.planar.instant import Instant

GAP = 0.05
TIMES = np.linspace(0.0, 1.5, 3001)
STOP, CORNER = 300.0, 2e-4
"""As the effect's docstring says [N m/rad, rad]."""


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

    def motion(t: float) -> tuple[float, float]:
        return float(np.sum(amplitudes * np.sin(speeds * t))), float(np.sum(amplitudes * speeds * np.cos(speeds * t)))

    def now(t: float) -> Instant:
        theta, rate = motion(t)
        return Instant(moving(np.array([theta]), np.array([rate])), LOOSE, p)

    def rate(t: float, y: np.ndarray) -> float:
        here = now(t)
        left = lambda v: float(one.effect.state_balance(here, one.values, y, np.array([v]))[0])  # noqa: E731
        return brentq(left, -1e3, 1e3, xtol=1e-12)

    start = one.effect.initial_state(np.array([motion(0.0)[0]]), LOOSE, one.values, p)
    found = solve_ivp(lambda t, y: [rate(t, y)], (0.0, TIMES[-1]), start, "BDF", TIMES, rtol=1e-8, atol=1e-10)
    ways = np.array([motion(t) for t in TIMES])
    rates = np.array([rate(t, y) for t, y in zip(TIMES, found.y.T, strict=True)])
    carried = [
        one.effect.torque(now(t), one.values, y, np.array([v]))
        + spring_torque(np.array([theta]), p)
        + joint_friction(np.array([turn]), p)
        for t, y, v, (theta, turn) in zip(TIMES, found.y.T, rates, ways, strict=True)
    ]
    return Turned(p, ways[:, 0], ways[:, 1], found.y[0], rates, np.array(carried)[:, 0])


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
    """What went in, less what spring and stops hold, never falls."""
    random = np.random.default_rng(4)
    for _ in range(2):
        run = turned(random.uniform(0.02, 0.15, 4), random.uniform(3, 25, 4))
        power = run.torque * run.rate
        work = np.concatenate([[0.0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(TIMES))])
        stiffness = run.p.stiffness[0]
        ball = stiffness * (1 + stiffness / STOP) * (run.ball - run.p.rest_angle[0]) ** 2 / 2

        def rounded(x: np.ndarray) -> np.ndarray:
            return (x * np.hypot(x, CORNER) + CORNER**2 * np.arcsinh(x / CORNER)) / 2

        held = ball + (STOP + stiffness) * (run.y**2 - rounded(run.y + GAP) + rounded(run.y - GAP)) / 2
        lost = work - (held - held[0])
        assert np.diff(lost).min() > -1e-4
        assert lost[-1] > 0.05


def test_a_resting_ball_leans_on_the_stop_that_its_spring_pulls_it_to() -> None:
    p = replace(prototype_model(5).parameters, rest_angle=np.full(5, 0.1))
    one = active(effect_of("backlash"), 5, gap=GAP)
    theta = 0.1 + np.array([0.3, 0.02, 0.0, -0.02, -0.3])
    y = one.effect.initial_state(theta, LOOSE, one.values, p)
    np.testing.assert_allclose(y, [GAP, 0.02, 0.0, -0.02, -GAP], atol=2e-3)
    now = Instant(moving(theta, np.zeros(5)), LOOSE, p)
    carried = one.effect.torque(now, one.values, y, np.zeros(5)) + spring_torque(theta, p)
    np.testing.assert_allclose(carried, p.stiffness * [0.25, 0.0, 0.0, 0.0, -0.25], atol=2e-3)


def test_without_play_only_the_stops_give_way() -> None:
    p = prototype_model(5).parameters
    one = active(effect_of("backlash"), 5)
    theta = np.array([0.3, 0.02, 0.0, -0.02, -0.3])
    y = one.effect.initial_state(theta, LOOSE, one.values, p)
    now = Instant(moving(theta, np.zeros(5)), LOOSE, p)
    np.testing.assert_allclose(one.effect.torque(now, one.values, y, np.zeros(5)), 0, atol=1e-13)
    np.testing.assert_allclose(y, spring_torque(theta, p) / (STOP + p.stiffness), rtol=1e-9)
