"""One interval of Eq. 12 against simulations, differences, and the exponential of a linear arm."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
import scipy.linalg
from arm_interval import LONG, SHORT, SMOOTH, Arm, linear_arm, relative
from continuum_laws.differences import differences
from continuum_laws.strategies import LAW
from estimation_arm import N, constrained, drawn_values, left_side, run_over, slipping, structure
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.integration.esdirk_tableau import fourth_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.values import with_vector
from continuum.estimation.friction_modes import FrictionModes
from continuum.estimation.run import Trajectory
from continuum.estimation.transition import transition

pytestmark = pytest.mark.slow

SEEDS = st.integers(0, 10**6)


@lru_cache
def exact() -> Simulator:
    return Simulator(structure().model, Tolerances(1e-10, 1e-11, 1e-3), fourth_order())


def missed_by_simulation(arm: Arm, rows: int) -> tuple[float, float]:
    """By how much ends and derivatives of a few intervals miss exact simulations, relative to what changes."""
    times = np.linspace(0.0, 0.008, rows + 1)
    tensions, still = Tensions(np.zeros(1), arm.u[None]), np.zeros((rows + 1, N))
    output = exact().run(arm.x, times, tensions, arm.values)
    run, way = run_over(times, arm.u), Trajectory(output.theta, output.theta_rate, still, still)
    modes = slipping(np.tile(np.sign(arm.x[N:]), (rows, 1)))
    found = transition(
        structure().equations, run, way, modes, arm.values, arm.values, np.zeros((int(run.first[-1]), N))
    )
    nothing = np.zeros((arm.values.size, 2 * N))
    one = exact().run(arm.x, times[:2], tensions, arm.values, nothing, np.eye(2 * N))
    return (
        relative(found.end, output.states[1:], np.ptp(output.theta_rate)) * rows,
        relative(found.F[0], one.sensitivities[-1], one.sensitivities[-1] - np.eye(2 * N)),
    )


@pytest.mark.parametrize("with_effects", [False, True])
def test_intervals_tend_to_the_simulation(with_effects: bool) -> None:
    """The ends to second order, their derivatives by the state to first order, as substeps are halved twice."""
    arms = [Arm.drawn(seed, with_effects, **SMOOTH) for seed in range(6)]
    (end, slope), (end_short, slope_short) = (
        np.mean([missed_by_simulation(arm, rows) for arm in arms], axis=0) for rows in (16, 64)
    )
    assert end_short < min(end / 8, 0.01)
    assert slope_short < min(slope / 2.5, 0.05)


@LAW
@given(SEEDS)
def test_the_derivative_by_the_state_is_that_of_the_end(seed: int) -> None:
    """But for what the exponential itself changes, which vanishes with the length."""
    arm, short = Arm.drawn(seed, **SMOOTH), 1e-5
    gained = arm.gained(short)
    sensitivities = differences(lambda x: arm.over(short, x=x, gained=gained).end[0], arm.x, 1e-4)
    change, missed = sensitivities - np.eye(2 * N), arm.over(short, gained=gained).F[0] - sensitivities
    assert np.max(np.abs(missed).max(axis=0) / np.abs(change[N:]).max(axis=0)) < 0.01


@LAW
@given(SEEDS, st.sampled_from([None, 0, 1, 2]), st.booleans())
def test_derivatives_by_torque_are_those_of_the_end(seed: int, joint: int | None, several: bool) -> None:
    """Of one substep, or of several of a linear arm: else exponentials change with the torque of substeps before."""
    arm, random = linear_arm(seed) if several else Arm.drawn(seed), np.random.default_rng(seed)
    length, rows = (LONG, arm.substeps(LONG)) if several else (SHORT, 1)
    modes = arm.slips if joint is None else constrained(arm.slips, joint, random.normal(0, 20))
    reference = arm.values if several else drawn_values(random)
    found = arm.over(length, modes, reference=reference)

    def by_held(held: np.ndarray) -> np.ndarray:
        return arm.over(length, modes, held=held.reshape(rows, N)).end[0]

    def by_missing(d: np.ndarray) -> np.ndarray:
        return arm.over(length, modes, d=d, reference=reference).end[0]

    assert relative(np.hstack(list(found.W)), differences(by_held, np.zeros(rows * N), 1e-3)) < 1e-6
    assert relative(found.D[0], differences(by_missing, np.zeros(N), 1e-3)) < 1e-6


@LAW
@given(SEEDS, st.lists(st.sampled_from([-1.0, 0.0, 1.0]), min_size=N, max_size=N), st.sampled_from([SHORT, LONG]))
def test_process_noise_is_a_covariance(seed: int, sign: list[float], length: float) -> None:
    arm, random = Arm.drawn(seed), np.random.default_rng(seed)
    slips = np.abs(np.array([sign]))
    noise = [random.uniform(0, 3, (1, N)) * (1 - slips), random.uniform(0, 1e-2, (1, N)) * slips]
    modes = FrictionModes(np.array([sign]), *noise, random.normal(0, 20, (1, N)))
    found = arm.over(length, modes).noise[0]
    np.testing.assert_array_equal(found, found.T)
    assert np.linalg.eigvalsh(found)[0] > -1e-12 * np.linalg.eigvalsh(found)[-1]
    louder = arm.over(length, replace(modes, rate_noise=3 * noise[0], torque_noise=3 * noise[1])).noise[0]
    np.testing.assert_allclose(louder, 9 * found, rtol=1e-9, atol=1e-12 * np.abs(found).max())
    assert not np.any(arm.over(length, replace(modes, rate_noise=0 * noise[0], torque_noise=0 * noise[1])).noise)


@LAW
@given(SEEDS, st.floats(1e-8, 1e-6))
def test_the_noise_of_rates_is_that_of_white_torque(seed: int, short: float) -> None:
    """Whose variance grows in proportion to time."""
    arm, random = Arm.drawn(seed), np.random.default_rng(seed)
    intensity = random.uniform(1e-4, 1e-2, N)
    found = arm.over(short, replace(arm.slips, torque_noise=intensity[None]))
    by_torque = found.D[0, N:] / (short)
    white = by_torque @ np.diag(intensity**2) @ by_torque.T * short
    np.testing.assert_allclose(found.noise[0, N:, N:], white, rtol=1e-2, atol=1e-6 * np.abs(white).max())


@LAW
@given(SEEDS, st.integers(0, N - 1), st.sampled_from([SHORT, LONG]), st.floats(-50, 50), st.floats(0, 5))
def test_a_constrained_joint_follows_its_acceleration(
    seed: int, joint: int, length: float, acceleration: float, rate_noise: float
) -> None:
    """Whatever the others do, and what is missing; its rate's noise is that of white acceleration."""
    arm = Arm.drawn(seed)
    held = np.random.default_rng(seed).normal(0, 1, (arm.substeps(length), N))
    found = arm.over(length, constrained(arm.slips, joint, acceleration, rate_noise), held=held, gained=1.0)
    params = [joint, N + joint]
    moved = length * np.array([arm.x[N + joint] + acceleration * length / 2, acceleration])
    np.testing.assert_allclose(found.end[0, params], arm.x[params] + moved, rtol=1e-9, atol=1e-9)
    by_state = np.zeros((2, 2 * N))
    by_state[:, params] = [[1.0, length], [0.0, 1.0]]
    np.testing.assert_allclose(found.F[0, params], by_state, rtol=1e-9, atol=1e-9)
    assert not np.any(found.D[0, params])
    assert not np.any(found.D[0, :, joint])
    assert not np.any(found.W[:, params])
    assert not np.any(found.W[:, :, joint])
    white = rate_noise**2 * np.array([[length**2 / 3, length / 2], [length / 2, 1.0]])
    np.testing.assert_allclose(found.noise[0][np.ix_(params, params)], white, rtol=1e-6, atol=1e-12)


@LAW
@given(SEEDS, st.lists(st.booleans(), min_size=N, max_size=N))
def test_accelerations_amid_the_substeps_balance_the_equations(seed: int, given_joints: list[bool]) -> None:
    """At joints that slip, with what is held; the others have the acceleration that they are given."""
    arm, random = Arm.drawn(seed), np.random.default_rng(seed)
    modes, run = arm.slips, arm.interval(LONG)
    wanted, held = random.normal(0, 20, N), random.normal(0, 0.1, (arm.substeps(LONG), N))
    for joint in np.flatnonzero(given_joints):
        modes = constrained(modes, int(joint), wanted[joint])
    found = arm.over(LONG, modes, held=held)
    x1 = np.stack([arm.x[:N], arm.x[:N] + LONG * arm.x[N:]])
    q, w = run.between(Trajectory(x1, np.stack([arm.x[N:]] * 2), 0 * x1, 0 * x1))
    model, slips = with_vector(structure().model, arm.values), ~np.array(given_joints)
    for k, acceleration in enumerate(found.acceleration):
        left = left_side(model, np.concatenate([q[k], w[k]]), acceleration, arm.u, found.slip[k])
        np.testing.assert_allclose(left[slips], held[k, slips], rtol=1e-8, atol=1e-10)
        np.testing.assert_array_equal(acceleration[~slips], wanted[~slips])


@LAW
@given(SEEDS, st.integers(0, N - 1), st.sampled_from([SHORT, LONG]), st.floats(0.1, 5))
def test_the_noise_of_a_given_rate_moves_the_other_joints(
    seed: int, joint: int, length: float, rate_noise: float
) -> None:
    """As another acceleration of that joint does, over the whole interval."""
    arm = linear_arm(seed)

    def by_acceleration(acceleration: np.ndarray) -> np.ndarray:
        return arm.over(length, constrained(arm.slips, joint, acceleration[0])).end[0]

    way = differences(by_acceleration, np.zeros(1), 1.0)[:, 0] * rate_noise / length
    quiet = replace(arm.slips, torque_noise=np.zeros((1, N)))
    found, expected = arm.over(length, constrained(quiet, joint, 0.0, rate_noise)).noise[0], np.outer(way, way)
    found[joint, joint] = expected[joint, joint]  # white within the interval, too
    np.testing.assert_allclose(found, expected, rtol=1e-5, atol=1e-7 * np.abs(expected).max())


@LAW
@given(SEEDS, st.sampled_from([SHORT, LONG]))
def test_an_interval_of_a_linear_arm_is_exact(seed: int, length: float) -> None:
    """However stiff it is, and however far the trajectory is from it."""
    arm = linear_arm(seed)
    held = np.tile(np.random.default_rng(seed).normal(0, 0.1, N), (arm.substeps(length), 1))
    found = arm.over(length, held=held, gained=1.0)
    model = with_vector(structure().model, arm.values)

    def left(x: np.ndarray, v: np.ndarray) -> np.ndarray:
        return left_side(model, x, v, arm.u, found.slip[0])

    at_rest, none = np.zeros(2 * N), np.zeros(N)
    inverse = np.linalg.inv(differences(lambda v: left(at_rest, v), none, 1.0))
    by_state, push = -inverse @ differences(lambda x: left(x, none), at_rest, 1.0), np.zeros(2 * N)
    push[N:] = inverse @ (held[0] + arm.d - left(at_rest, none))
    one = scipy.linalg.block_diag(np.eye(N), inverse)[:, N:]
    whole = np.zeros((3 * N + 1, 3 * N + 1))
    whole[:N, N : 2 * N], whole[N : 2 * N, : 2 * N] = np.eye(N), by_state
    whole[: 2 * N, 2 * N : 3 * N], whole[: 2 * N, -1] = one, push
    flow = scipy.linalg.expm(length * whole)[: 2 * N]
    expected = flow[:, : 2 * N] @ arm.x + flow[:, -1]
    for part, wanted in ((found.F[0], flow[:, : 2 * N]), (found.D[0], flow[:, 2 * N : -1]), (found.end[0], expected)):
        assert relative(part[:N], wanted[:N]) < 1e-5
        assert relative(part[N:], wanted[N:]) < 1e-5
