"""Effects of cables and motors: virtual work, and the limits in which they are something known."""

from dataclasses import replace

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import active, moving, prototype_model, random_parameters
from effects_laws import LOOSE, RELEASED, N, effect_of, extended, resting_state, simulator, torque_of

from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.tensions import Tensions
from continuum.effects.parts.cables import lengthening, lengthening_rate


def test_a_held_cable_is_the_slope_of_its_energy() -> None:
    p = replace(random_parameters(np.random.default_rng(9), N), capstan_friction=np.zeros(1))
    slacks = {"slack_1": 0.01, "slack_2": 0.03}
    for theta in (np.array([0.4, 0.3, 0.5, 0.1, 0.2]), -np.array([0.4, 0.3, 0.5, 0.1, 0.2])):

        def energy(q: np.ndarray) -> np.ndarray:
            y = np.maximum(lengthening(moving(q, 0 * q), p) - np.array([0.01, 0.03]), 0)
            return np.sum(200.0 * y**2 / 2)

        now = Instant(moving(theta, 0 * theta), LOOSE, p)
        found = torque_of("slack_cable", now, stiffness=200.0, **slacks)
        assert np.abs(found).max() > 0.01
        np.testing.assert_allclose(found, differences(energy, theta, 1e-3), rtol=0.02)
        rate = differences(lambda q: lengthening(moving(q, 0 * q), p), theta) @ (1.0 + theta)
        np.testing.assert_allclose(lengthening_rate(moving(theta, 1.0 + theta), p), rate, rtol=1e-9)


def test_a_held_cable_loses_when_drawn_out_and_returns_no_more_than_it_took() -> None:
    p = replace(prototype_model(N).parameters, capstan_friction=np.zeros(1))
    theta, values = np.full(N, 0.3), {"stiffness": 200.0, "slack_1": 0.01, "slack_2": 0.01}

    def held(w: float) -> float:
        return float(torque_of("slack_cable", Instant(moving(theta, np.full(N, w)), LOOSE, p), **values)[0])

    assert held(3.0) > 1.5 * held(0.0) > 0
    assert held(-3.0) == pytest.approx(held(0.0), rel=1e-3)
    for w in np.linspace(-0.2, 0.2, 41):
        assert (held(w) - held(0.0)) * w >= 0


def test_a_cable_that_is_pulled_is_not_held_and_a_loose_one_does_nothing() -> None:
    p, values = prototype_model(N).parameters, {"stiffness": 200.0, "slack_1": 0.01, "slack_2": 0.01}
    bent, straight = moving(np.full(N, 0.3), np.zeros(N)), moving(np.zeros(N), np.zeros(N))
    loose, pulled = (torque_of("slack_cable", Instant(bent, np.array([0.0, u]), p), **values) for u in (0.0, 5.0))
    assert np.abs(pulled).max() < 1e-3 * np.abs(loose).max()
    assert np.abs(torque_of("slack_cable", Instant(straight, LOOSE, p), **values)).max() < 1e-4


def test_motors_follow_as_a_lag_of_first_order() -> None:
    step = Tensions([0.0, 1e-6, 1.0], [[0.0, 0.0], [6.0, 2.0], [6.0, 2.0]])
    model, times = extended(prototype_model(N), "actuator_lag", {"lag": 0.05}), np.linspace(0, 0.2, 9)
    run = simulator("actuator_lag").around(model).run(resting_state(model, 0 * RELEASED, LOOSE), times, step)
    rising = 1 - np.exp(-times / (0.05 + 1e-5))
    np.testing.assert_allclose(run.states[:, 2 * N :], rising[:, None] * [6.0, 2.0], atol=1e-4)


def test_an_elastic_cable_of_an_arm_that_is_held_is_a_lag_and_of_a_motor_that_is_held_a_spring() -> None:
    p, state = prototype_model(N).parameters, np.array([4.0, 2.0])
    elastic, lag = (
        active(effect_of("elastic_cable"), lag=0.05, stiffness=700.0),
        active(effect_of("actuator_lag"), lag=0.05),
    )
    u, rates = np.array([5.0, 1.0]), np.array([3.0, -2.0])
    still = Instant(moving(RELEASED, np.zeros(N)), u, p)
    found, expected = (one.effect.state_balance(still, one.values, state, rates) for one in (elastic, lag))
    np.testing.assert_allclose(found, expected)
    drawn = Instant(moving(RELEASED, np.full(N, 0.5)), state, p)  # told just what it pulls: the motor holds
    rate = 700.0 * lengthening_rate(drawn.motion, p) * state**2 / (state**2 + 0.01)
    np.testing.assert_allclose(elastic.effect.state_balance(drawn, elastic.values, state, rate), 0, atol=1e-9)


@pytest.mark.parametrize("name", ["actuator_lag", "elastic_cable", "capstan"])
def test_a_release_without_pull_does_not_know_of_the_cables(name: str) -> None:
    times = np.linspace(0, 0.2, 5)
    runs = []
    for scale in (0.0, 1.0):
        model = extended(
            prototype_model(N),
            name,
            {k: p.default + scale * p.typical for k, p in effect_of(name).parameters.items()},
        )
        runs.append(simulator(name).around(model).run(resting_state(model, RELEASED, LOOSE), times).theta)
    np.testing.assert_allclose(runs[0], runs[1], atol=1e-9)
