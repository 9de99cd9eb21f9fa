"""One recording window by window: slopes beside differences, what runs on from window to window, whitened errors."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from identification_laws import (
    ANGLE_NOISE,
    BENDS,
    FINE,
    PULLS,
    RATE_NOISE,
    N,
    recorded,
    small_simulator,
    white_noise,
)

from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.measuring import readings
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_vector
from continuum.identification.free import Free, FreeSpace
from continuum.identification.noise import Channel, Noise
from continuum.identification.recording import Recording
from continuum.identification.sensors import first_state
from continuum.identification.window_residual import WindowAt, WindowResidual
from continuum.identification.window_settling import descended
from continuum.identification.windows import usual_length, whitener, window_rows

WITH_DRIFT = Noise(
    Channel(ANGLE_NOISE**2 * np.array([[1.0, -0.5], [-0.5, 1.0]]), 1.0, 0.5, 2.0, 0.5),
    Channel(RATE_NOISE**2 * np.eye(N), 0.02, np.inf),
)
BASELINE = (Free("stiffness"), Free("viscous_friction"), Free("coulomb_friction"), Free("stiffness", 1, tolerance=0.02))
EFFECTS = {
    None: (),
    "tip_payload": (Free("tip_payload.mass"),),
    "angle_offset": (Free("angle_offset.offset", 1, 0), Free("angle_offset.offset", 1, 1)),
    "gyro_drift": (Free("gyro_drift.bias", 0, 0),),
    "sensor_delay": (Free("sensor_delay.delay"),),
    "sensor_scale": (Free("sensor_scale.gain", 0),),
    "actuator_lag": (Free("actuator_lag.lag"),),
    "elastic_cable": (Free("elastic_cable.lag"), Free("elastic_cable.stiffness")),
    "presliding": (Free("presliding.angle"),),
    "base_compliance": (Free("base_compliance.compliance"), Free("base_compliance.frequency")),
    "backlash": (Free("backlash.gap", 0),),
    "slack_cable": tuple(Free(f"slack_cable.{name}") for name in ("slack", "speed", "least", "blur", "taut")),
}
SUDDEN = Tolerances(3e-9, 3e-10, 0.001)  # where a motor that is told ever less suddenly lets go
STEP = 0.004
"""Of the differences, in units of the coordinates."""


def residual(effect: str | None, length: float | None = 0.067, noise: Noise = WITH_DRIFT) -> WindowResidual:
    simulator = small_simulator(effect, SUDDEN if effect == "slack_cable" else FINE)
    run = recorded(simulator, BENDS[0], np.random.default_rng(0), {"stiffness": 1.4}, 0.3, PULLS)
    return WindowResidual(simulator, run, 0, noise, FreeSpace(simulator.model, BASELINE + EFFECTS[effect]), length)


def chained(one: WindowResidual, shared: np.ndarray, own: list[np.ndarray]) -> list[WindowAt]:
    """Every window, each with the memory of the one before."""
    memory, found = None, []
    for window, mine in enumerate(own):
        at = one.window(window, shared, mine, memory)
        assert at is not None
        memory = at.memory
        found.append(at)
    return found


def errors(one: WindowResidual, shared: np.ndarray, own: list[np.ndarray]) -> np.ndarray:
    return np.concatenate([at.part.errors for at in chained(one, shared, own)])


def somewhere(one: WindowResidual) -> tuple[np.ndarray, list[np.ndarray]]:
    """A place away from where everything is absent."""
    random = np.random.default_rng(1)
    return 0.5 + 0.2 * random.random(len(one.space.unknowns)), [0.3 * random.normal(size=2 * N) for _ in one.rows]


def slope_along(function: Callable[[float], np.ndarray]) -> np.ndarray:
    """At 0, by central differences of fourth order: residuals are curved where something knocks."""
    near, far = ((function(step) - function(-step)) / (2 * step) for step in (STEP, 2 * STEP))
    return (4 * near - far) / 3


@pytest.mark.parametrize("effect", EFFECTS)
def test_slopes_by_the_shared_unknowns(effect: str | None) -> None:
    """Also those that a window before left in the states of an effect."""
    one = residual(effect)
    assert len(one.rows) >= 4
    shared, own = somewhere(one)
    found = np.concatenate([at.part.by_shared for at in chained(one, shared, own)])
    for i, unit in enumerate(np.eye(shared.size)):
        slope = slope_along(lambda step, unit=unit: errors(one, shared + step * unit, own))
        if one.space.unknowns[i].recording == 1:
            assert not np.any(slope)
            assert not np.any(found[:, i])
            continue
        size = np.max(np.abs(slope))
        assert size > 1e-3
        np.testing.assert_allclose(found[:, i], slope, rtol=0, atol=0.01 * size, err_msg=str(one.space.unknowns[i]))


@pytest.mark.parametrize("effect", [None, "sensor_delay", "actuator_lag", "base_compliance", "backlash", "presliding"])
@pytest.mark.parametrize("window", [0, 1])
def test_slopes_by_a_windows_first_state(effect: str | None, window: int) -> None:
    """Also those by way of effects that rest with the arm where a run begins, or nearly so."""
    one = residual(effect)
    shared, own = somewhere(one)
    memory = chained(one, shared, own)[0].memory if window else None
    at = one.window(window, shared, own[window], memory)
    assert at is not None

    def errors_of(mine: np.ndarray) -> np.ndarray:
        there = one.window(window, shared, mine, memory)
        assert there is not None
        return there.part.errors

    for i, unit in enumerate(np.eye(own[window].size)):
        slope = slope_along(lambda step, unit=unit: errors_of(own[window] + step * unit))
        np.testing.assert_allclose(at.part.by_own[:, i], slope, rtol=0, atol=0.01 * np.max(np.abs(slope)))


def simulated(simulator: Simulator, seconds: float = 0.6) -> Recording:
    return recorded(simulator, BENDS[0], seconds=seconds, tensions=PULLS)


@pytest.mark.parametrize("effect", [None, "actuator_lag", "presliding", "base_compliance"])
@pytest.mark.parametrize("length", [0.067, 0.2, None])
def test_at_the_truth_nothing_is_left_of_a_run_without_noise(effect: str | None, length: float | None) -> None:
    """Effects' states run on: were they begun anew with each window, errors would be left."""
    simulator = small_simulator(effect)
    space = FreeSpace(simulator.model, BASELINE + EFFECTS[effect])
    truth = simulator.around(simulator.model.with_values(dict.fromkeys([u.name for u in EFFECTS[effect]], 0.05) if
                             effect in ("actuator_lag", "presliding") else {}))  # fmt: skip
    one = WindowResidual(truth, simulated(truth), 0, white_noise(), space_around(truth, space), length)
    left = errors(one, np.zeros(len(space.unknowns)), one.start)
    assert np.max(np.abs(left)) < 0.02


def space_around(simulator: Simulator, space: FreeSpace) -> FreeSpace:
    return FreeSpace(simulator.model, space.unknowns)


@pytest.mark.parametrize("effect", [None, "actuator_lag", "angle_offset"])
def test_simulating_all_windows_gives_what_their_errors_are_made_of(effect: str | None) -> None:
    one = residual(effect, noise=white_noise())
    shared, own = somewhere(one)
    seen = one.simulate(shared, own)
    assert seen is not None
    assert one.recording.theta_rate is not None
    np.testing.assert_array_equal(seen.times, one.recording.times)
    angle, rate = (
        (seen.theta - one.recording.theta) / ANGLE_NOISE,
        (seen.theta_rate - one.recording.theta_rate) / RATE_NOISE,
    )
    expected = [np.concatenate([angle[rows].ravel(), rate[rows].ravel()]) for rows in one.rows]
    np.testing.assert_allclose(errors(one, shared, own), np.concatenate(expected), rtol=1e-6, atol=1e-6)


REMEMBERING = {"gyro_drift": {"bias": [0.1, -0.2]}, "sensor_scale": {"gain": 0.1}}


@pytest.mark.parametrize("effect", REMEMBERING)
@pytest.mark.parametrize("length", [0.03, 0.067, None])
def test_sensors_show_of_windows_what_they_show_of_the_whole_run(effect: str, length: float | None) -> None:
    """A drift goes on from the run's beginning."""
    simulator = small_simulator(effect)
    model = simulator.model.with_values({f"{effect}.{key}": value for key, value in REMEMBERING[effect].items()})
    times = 3.0 + np.arange(60) / 120
    motion = simulator.around(model).run(np.array(BENDS[0]), times)
    whole = readings(model, motion)
    run = Recording("run", times, whole.theta, whole.theta_rate)
    one = WindowResidual(simulator.around(model), run, 0, white_noise(), FreeSpace(model, ()), length)
    first = [one._sensors.meant(rows.start, parameter_vector(model)) for rows in one.rows]
    own = [(motion.states[rows.start] - at) / one._unit for rows, at in zip(one.rows, first, strict=True)]
    seen = one.simulate(np.zeros(0), own)
    assert seen is not None
    np.testing.assert_array_equal(seen.times, times)
    np.testing.assert_allclose(seen.theta, whole.theta, atol=1e-5)
    np.testing.assert_allclose(seen.theta_rate, whole.theta_rate, atol=1e-4)


@pytest.mark.parametrize("length", [0.067, None])
def test_late_sensors_show_the_motion_that_was(length: float | None) -> None:
    """Samples of a motion, stamped late while the tensions are not, are told by the delay without an error."""
    simulator, late = small_simulator("sensor_delay"), 5 / 120
    on_time = simulated(simulator)
    assert on_time.theta_rate is not None
    run = Recording("run", on_time.times[5:], on_time.theta[:-5], on_time.theta_rate[:-5], on_time.tensions)
    truth = simulator.around(simulator.model.with_values({"sensor_delay.delay": late}))
    left = []
    for at in (truth, simulator):
        one = WindowResidual(at, run, 0, white_noise(), FreeSpace(at.model, ()), length)
        left.append(np.max(np.abs(errors(one, np.zeros(0), one.start))))
    assert left[0] < 0.02
    assert left[1] > 5


def test_windows_that_were_simulated_are_counted() -> None:
    one = residual(None)
    assert one.windows_simulated == 0
    chained(one, np.zeros(len(BASELINE)), one.start)
    assert one.windows_simulated == len(one.rows)


@pytest.mark.parametrize("effect", ["presliding", "actuator_lag", "backlash"])
def test_bad_windows_are_begun_anew_beside_effects_with_states(effect: str) -> None:
    """By a model that is far off, so that every window is bad."""
    simulator = small_simulator(effect)
    wrong = simulator.around(simulator.model.with_values({"stiffness": 3.0}))
    one = WindowResidual(wrong, simulated(simulator), 0, white_noise(), FreeSpace(wrong.model, ()), 0.067)
    found, anew = (descended(one, np.zeros(0), one.start, is_anew) for is_anew in (False, True))
    assert found is not None
    assert anew is not None
    assert [at.own.size for at in anew] == [start.size for start in one.start]
    assert all(at.end.size == 2 * N for at in anew)


def test_settled_windows_are_no_worse_and_near_their_truth() -> None:
    """From first states as measured, with their noise, to those that explain their windows."""
    simulator = small_simulator()
    clean = recorded(simulator, BENDS[1])
    noisy = recorded(simulator, BENDS[1], np.random.default_rng(4))
    one = WindowResidual(simulator, noisy, 0, white_noise(), FreeSpace(simulator.model, BASELINE), 0.067)
    shared = np.zeros(len(BASELINE))
    before, after = chained(one, shared, one.start), descended(one, shared, one.start, False)
    assert after is not None

    def size(found: list[WindowAt]) -> float:
        return float(sum(at.part.errors @ at.part.errors for at in found))

    assert size(after) < size(before)
    assert size(after) < 1.3 * sum(at.part.errors.size for at in after)
    assert clean.theta_rate is not None
    seen = one.simulate(shared, [at.own for at in after])
    assert seen is not None
    assert np.std(seen.theta - clean.theta) < 0.7 * ANGLE_NOISE
    assert np.std(seen.theta_rate - clean.theta_rate) < 0.7 * RATE_NOISE


def test_a_first_state_in_which_slow_joints_rest() -> None:
    one = residual(None)
    measured = first_state(one.recording, one.rows[2].start)
    unit = one.still(2, np.inf)
    only_fast = one.still(2, 0.0)
    state = measured + one._unit * unit
    np.testing.assert_allclose(state[N:], 0.0, atol=1e-12)
    np.testing.assert_array_equal(state[:N], measured[:N])
    np.testing.assert_array_equal(only_fast, 0.0)


def test_first_rates_that_were_not_measured() -> None:
    """Slopes of a parabola through the samples around, exact for a parabola; at the start through those after it."""
    t = np.arange(40) / 120
    theta = np.stack([0.3 - 2 * t + 4 * t**2, t], axis=1)
    run = Recording("parabola", t, theta)
    for row in (0, 5, 20, 39):
        np.testing.assert_allclose(first_state(run, row), [*theta[row], -2 + 8 * t[row], 1.0], atol=1e-9)
    rates = replace(run, theta_rate=np.ones((40, 2)))
    np.testing.assert_array_equal(first_state(rates, 7), [*theta[7], 1.0, 1.0])


@given(st.integers(8, 400), st.floats(0.01, 2.0), st.integers(0, 5))
def test_windows_cut_a_run_without_gap_or_overlap(samples: int, length: float, seed: int) -> None:
    times = np.cumsum(np.random.default_rng(seed).uniform(0.003, 0.02, samples))
    rows = window_rows(Recording("run", times, np.zeros((samples, 1))), length)
    assert np.concatenate([np.arange(samples)[one] for one in rows]).tolist() == list(range(samples))
    assert all(one.stop - one.start > 1 for one in rows)


def test_windows_have_the_length_that_was_asked_for() -> None:
    run = Recording("run", np.arange(241) / 120, np.zeros((241, 1)))
    rows = window_rows(run, 0.1)
    assert len(rows) == 20
    assert window_rows(run, None) == [slice(0, 241)]
    with_rates = replace(run, theta_rate=np.zeros((241, 1)))
    assert usual_length(run) > usual_length(with_rates)


def test_whitened_errors_are_independent_and_of_unit_variance() -> None:
    """Drawn often from the covariance that the noise states, over joints and time."""
    times, random, draws = np.arange(5) / 120, np.random.default_rng(7), 40_000
    run = Recording("run", times, np.zeros((5, N)), np.zeros((5, N)))

    def drawn(channel: Channel) -> np.ndarray:
        time, joints = np.linalg.cholesky(channel.in_time(times)), np.linalg.cholesky(channel.joints)
        return np.einsum("ts,sjd,kj->tkd", time, random.normal(size=(5, N, draws)), joints)

    assert WITH_DRIFT.rate is not None
    white = whitener(WITH_DRIFT, run, slice(0, 5))(drawn(WITH_DRIFT.angle), drawn(WITH_DRIFT.rate))
    assert white.shape == (20, draws)
    np.testing.assert_allclose(np.cov(white), np.eye(20), atol=0.03)
