"""Effects of cables and motors: virtual work, and the limits in which they are something known."""

from dataclasses import replace

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import active, moving, prototype_model, random_parameters
from effects_laws import LOOSE, RELEASED, N, effect_of, extended, resting_state, simulator, torque_of

from continuum.dynamics.model import Model
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions, slack
from continuum.dynamics.trajectory import SimulationStatus
from continuum.effects._parts import lengthening, lengthening_rate


def test_a_held_cable_is_the_derivative_of_its_energy() -> None:
    p = replace(random_parameters(np.random.default_rng(9), N), capstan_friction=np.zeros(1))
    slacks = {"slack_1": 0.01, "slack_2": 0.03}
    for theta in (np.array([0.4, 0.3, 0.5, 0.1, 0.2]), -np.array([0.4, 0.3, 0.5, 0.1, 0.2])):

        def energy(q: np.ndarray) -> np.ndarray:
            y = np.maximum(lengthening(moving(q, 0 * q), p) - np.array([0.01, 0.03]), 0)
            return np.sum(200.0 * y**2 / 2)

        now = Instant(moving(theta, 0 * theta), LOOSE, p)
        found = torque_of("held_cable", now, stiffness=200.0, **slacks)
        assert np.abs(found).max() > 0.01
        np.testing.assert_allclose(found, differences(energy, theta, 1e-3), rtol=0.02)
        rate = differences(lambda q: lengthening(moving(q, 0 * q), p), theta) @ (1.0 + theta)
        np.testing.assert_allclose(lengthening_rate(moving(theta, 1.0 + theta), p), rate, rtol=1e-9)


def test_a_held_cable_loses_when_drawn_out_and_returns_no_more_than_it_took() -> None:
    p = replace(prototype_model(N).parameters, capstan_friction=np.zeros(1))
    theta, values = np.full(N, 0.3), {"stiffness": 200.0, "slack_1": 0.01, "slack_2": 0.01}

    def held(w: float) -> float:
        return float(torque_of("held_cable", Instant(moving(theta, np.full(N, w)), LOOSE, p), **values)[0])

    assert held(3.0) > 1.5 * held(0.0) > 0
    assert held(-3.0) == pytest.approx(held(0.0), rel=1e-3)
    for w in np.linspace(-0.2, 0.2, 41):
        assert (held(w) - held(0.0)) * w >= 0


def test_a_cable_that_is_pulled_is_not_held_and_a_loose_one_does_nothing() -> None:
    p, values = prototype_model(N).parameters, {"stiffness": 200.0, "slack_1": 0.01, "slack_2": 0.01}
    bent, straight = moving(np.full(N, 0.3), np.zeros(N)), moving(np.zeros(N), np.zeros(N))
    loose, pulled = (torque_of("held_cable", Instant(bent, np.array([0.0, u]), p), **values) for u in (0.0, 5.0))
    assert np.abs(pulled).max() < 1e-3 * np.abs(loose).max()
    assert np.abs(torque_of("held_cable", Instant(straight, LOOSE, p), **values)).max() < 1e-4


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
    drawn = Instant(moving(RELEASED, np.full(N, 0.5)), state, p)  # commanded the present tension: the motor holds
    rate = 700.0 * lengthening_rate(drawn.motion, p)
    np.testing.assert_allclose(elastic.effect.state_balance(drawn, elastic.values, state, rate), 0, atol=1e-9)


def test_a_cable_that_would_push_stays_loose_and_one_that_is_reported_nothing_resists() -> None:
    """Both while an arm that was bent to cable 1 swings back: that is drawn off its drum, the other comes loose."""
    model, times = extended(prototype_model(N), "elastic_cable", {"lag": 0.05, "stiffness": 500.0}), np.linspace(0, 0.1)
    output = Tensions([0.0], [[0.0, 0.0]])
    run = simulator("elastic_cable").around(model).run(resting_state(model, RELEASED, LOOSE), times, output)
    tension = run.states[:, 2 * N :]
    assert tension.min() > -1e-4
    assert tension[:, 0].max() > 0.5
    assert tension[:, 1].max() < 0.05


@pytest.mark.parametrize("name", ["actuator_lag", "elastic_cable", "slack_cable", "capstan", "tension_scale"])
def test_a_release_without_pull_does_not_know_of_the_cables(name: str) -> None:
    times = np.linspace(0, 0.2, 5)
    runs = []
    for scale in (0.0, 1.0):
        model = extended(
            prototype_model(N),
            name,
            {k: p.default + scale * p.typical for k, p in effect_of(name).parameters.items()},
        )
        runs.append(simulator(name).around(model).run(resting_state(model, RELEASED, slack().at(0.0)), times).theta)
    np.testing.assert_allclose(runs[0], runs[1], atol=1e-9)


@pytest.mark.parametrize("first", ["slack_cable", "elastic_cable"])
def test_a_cable_that_was_let_go_stays_so_however_loose(first: str) -> None:
    """Whichever of two effects comes first: what one makes of the tension is the other's command."""
    sizes = {"slack_cable": {"slack": 0.02}, "elastic_cable": {"lag": 0.01}}
    names = [first, *(name for name in sizes if name != first)]
    plain = prototype_model(N)
    model = replace(plain, effects=tuple(active(effect_of(name), N, **sizes[name]) for name in names))
    times, let_go = np.linspace(0, 0.3, 7), slack()
    with_both, without = (
        Simulator(one).run(resting_state(one, RELEASED, let_go.at(0.0)), times, let_go).theta for one in (model, plain)
    )
    np.testing.assert_allclose(with_both, without, atol=1e-3)


def wound_up(slack: float, speed: float, times: np.ndarray, u: Tensions) -> tuple[np.ndarray, np.ndarray]:
    """Joint angles, and what still hangs of each cable [m], of the arm from its straight rest."""
    model = extended(prototype_model(N), "slack_cable", {"slack": slack, "speed": speed})
    run = simulator("slack_cable").around(model).run(resting_state(model, 0 * RELEASED, LOOSE), times, u)
    assert run.status is SimulationStatus.COMPLETE
    return run.theta, run.states[:, 2 * N :]


STEP = Tensions([0.0, 1e-6, 1.0], [[0.0, 0.0], [6.0, 0.0], [6.0, 0.0]])


@pytest.mark.parametrize(("slack", "speed"), [(0.01, 0.3), (0.01, 0.1), (0.03, 0.3)])
def test_a_loose_cable_pulls_once_its_motor_has_wound_it_up(slack: float, speed: float) -> None:
    taut = slack / speed
    times = taut * np.array([0.0, 0.5, 0.8, 1.5, 2.0])
    theta, hanging = wound_up(slack, speed, times, STEP)
    at_once, _ = wound_up(0.0, speed, times, STEP)
    np.testing.assert_allclose(hanging[:3, 0], slack - speed * times[:3], atol=0.1 * slack)
    assert hanging[4, 0] < 0.02 * slack
    np.testing.assert_allclose(hanging[:, 1], slack, atol=0.02 * slack)
    assert np.abs(theta[2]).max() < 0.02 * np.abs(at_once[2]).max()
    assert np.abs(theta[4]).max() > 0.05 * np.abs(at_once[4]).max()


def test_what_hangs_stays_between_nothing_and_the_slack() -> None:
    """Also where the arm swings faster than the motors wind, and commands come and go."""
    model = extended(prototype_model(N), "slack_cable", {"slack": 0.01, "speed": 0.05})
    u = Tensions([0.0, 0.1, 0.2, 0.3, 0.5, 0.8], [[0, 0], [9, 0], [0, 0], [0, 9], [9, 9], [0, 0]])
    run = simulator("slack_cable").around(model).run(resting_state(model, RELEASED, LOOSE), np.linspace(0, 0.8, 97), u)
    hanging = run.states[:, 2 * N :]
    assert run.status is SimulationStatus.COMPLETE
    assert hanging.min() > -1e-5
    assert hanging.max() < 0.01 + 1e-5
    assert np.all(np.ptp(hanging, axis=0) > 0.009)


def test_an_arm_that_gives_way_to_its_cables_loosens_them_and_one_that_draws_them_tightens_them() -> None:
    """By as much as its path changes while motors stand still, commanded the tension at which they start to wind."""
    p, one = prototype_model(N).parameters, active(effect_of("slack_cable"), slack=0.05, speed=0.3)
    now = Instant(moving(RELEASED, np.full(N, 0.5)), one.values["least"] * np.ones(2), p)
    rate = -lengthening_rate(now.motion, p)
    assert rate[0] * rate[1] < 0
    left = one.effect.state_balance(now, one.values, np.full(2, 0.025), rate)
    np.testing.assert_allclose(left, 0, atol=1e-12)


def test_load_cells_show_one_plus_their_gain_times_what_pulls() -> None:
    params = {"gain_1": np.array([0.25]), "gain_2": np.array([-0.2])}
    np.testing.assert_allclose(effect_of("tension_scale").pull(np.array([5.0, 8.0]), params, np.zeros(0)), [4.0, 10.0])


def test_load_cells_that_are_both_off_are_an_arm_whose_torques_are_all_scaled() -> None:
    """u / (1 + e) moves an arm as u moves one of 1 + e times its masses, springs and friction."""
    p, gain = prototype_model(N).parameters, 0.2
    scaled = ("mass", "inertia", "stiffness", "viscous_friction", "coulomb_friction")
    heavier = Model(replace(p, **{name: (1 + gain) * getattr(p, name) for name in scaled}))
    shown = extended(Model(p), "tension_scale", {"gain_1": gain, "gain_2": gain})
    times, output = np.linspace(0, 0.4, 9), Tensions([0.0, 0.2, 0.4], [[0.0, 2.0], [5.0, 1.0], [0.0, 6.0]])
    plain = Simulator(Model(p)), simulator("tension_scale")
    seen, same = (
        one.around(model).run(resting_state(model, RELEASED, LOOSE), times, output).theta
        for one, model in zip(plain, (heavier, shown), strict=True)
    )
    np.testing.assert_allclose(seen, same, atol=2e-4)
    other = plain[0].run(resting_state(Model(p), RELEASED, LOOSE), times, output).theta
    assert np.abs(seen - other).max() > 0.01
