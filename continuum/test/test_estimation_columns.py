"""Columns of torque and of readings against differences of Eq. 12 and of the sensors in numbers."""

from dataclasses import replace

import numpy as np
import pytest
from continuum_laws.differences import differences
from continuum_laws.strategies import LAW
from estimation_arm import N, drawn_motion, drawn_params, drawn_values, missing, run_over, scene_along, structure
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.trajectory import Reading
from continuum.estimation.columns import (
    Change,
    LateInputs,
    Sensitivity,
    SensorSensitivity,
    assembled,
    to_states,
)
from continuum.estimation.run import Run, Trajectory
from continuum.estimation.structure import delay_of

pytestmark = pytest.mark.slow

SEEDS = st.integers(0, 10**6)
NAMES = list(structure().slots)
SENSORS = [(one, name) for one in structure().sensors for name in one.parameters if name != delay_of(one)]
ROWS = 5


def directions_of(name: str) -> np.ndarray:
    """Each value of a parameter by itself, (n_p, k)."""
    return np.eye(structure().equations.n_p)[:, structure().slots[name]]


@pytest.mark.parametrize("name", NAMES)
def test_a_derivative_is_the_derivative_of_the_torque(name: str) -> None:
    """By every parameter of Eq. 12 and of all effects without states, the slip rate as it is."""
    random = np.random.default_rng(NAMES.index(name))
    values, along, slot = drawn_values(random), drawn_motion(random, ROWS), structure().slots[name]

    def torque(params: np.ndarray) -> np.ndarray:
        changed = values.copy()
        changed[slot] = params
        return missing(along, changed)

    found = Sensitivity(directions_of(name)).torque(scene_along(along, values))
    expected = differences(torque, values[slot], 0.01 * float(np.min(np.abs(values[slot]))))
    assert np.any(expected)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-8 * np.max(np.abs(expected)))


@LAW
@given(SEEDS, st.sampled_from(NAMES))
def test_a_derivative_along_directions_is_the_sum_of_its_parts_where_values_were_changed(seed: int, name: str) -> None:
    random = np.random.default_rng(seed)
    values, along = drawn_values(random), drawn_motion(random, ROWS)
    directions = random.normal(0, 1, (values.size, 2))
    changed, elsewhere = {name: values[structure().slots[name]] * random.uniform(0.5, 1.5)}, values.copy()
    elsewhere[structure().slots[name]] = changed[name]
    found = Sensitivity(directions, changed).torque(scene_along(along, values))
    parts = Sensitivity(np.eye(values.size)).torque(scene_along(along, elsewhere))
    np.testing.assert_allclose(found, parts @ directions, rtol=1e-9, atol=1e-9 * np.abs(parts).max())


@LAW
@given(SEEDS, st.sampled_from(NAMES), st.sampled_from(NAMES))
def test_a_change_is_the_torque_there_less_that_here(seed: int, one: str, other: str) -> None:
    random = np.random.default_rng(seed)
    values, along = drawn_values(random), drawn_motion(random, ROWS)
    factors, there = {one: random.uniform(0.5, 1.5), other: random.uniform(0.5, 1.5)}, values.copy()
    for name, factor in factors.items():
        there[structure().slots[name]] *= factor
    found = Change(factors).torque(scene_along(along, values))
    np.testing.assert_allclose(found[:, :, 0], missing(along, there) - missing(along, values), atol=1e-9)


@LAW
@given(SEEDS)
def test_what_a_recording_has_for_itself_counts_in_its_columns(seed: int) -> None:
    """A parameter's own value in a run takes the place of the common one."""
    random = np.random.default_rng(seed)
    values, along = drawn_values(random), drawn_motion(random, ROWS)
    params = {"remounted_base": {"angle": random.normal(0, 0.3, 1)}}
    here = values.copy()
    here[structure().slots["remounted_base.angle"]] = params["remounted_base"]["angle"]
    scene = scene_along(along, values, params)
    np.testing.assert_allclose(scene.nominal(), missing(along, here), rtol=1e-9, atol=1e-10)
    sensitivities = Sensitivity(directions_of("stiffness")).torque(scene)
    np.testing.assert_allclose(
        sensitivities, Sensitivity(directions_of("stiffness")).torque(scene_along(along, here)), atol=1e-12
    )


@LAW
@given(SEEDS, st.floats(0.0, 0.05), st.booleans())
def test_late_inputs_are_those_of_a_signal_that_begins_later(seed: int, delay: float, held: bool) -> None:
    random = np.random.default_rng(seed)
    values, times = drawn_values(random), np.cumsum(random.uniform(0.003, 0.02, 8))
    signal = np.cumsum(random.uniform(0.002, 0.02, 12)), random.uniform(0, 5, (12, 2))
    run = replace(run_over(times), signal=signal, held=held)
    late = replace(run, signal=(signal[0] + delay, signal[1]))
    along = drawn_motion(random, int(run.first[-1]))
    along = replace(along, u=run.inputs, length=run.length)
    scene = replace(scene_along(along, values), run=run)
    expected = missing(along, values, late.inputs) - missing(along, values)
    np.testing.assert_allclose(LateInputs(delay).torque(scene)[:, :, 0], expected, rtol=1e-7, atol=1e-9)


def sensed(random: np.random.Generator, with_rates: bool) -> tuple[Run, Trajectory, dict[str, dict[str, np.ndarray]]]:
    """A run that begins some time after zero, a trajectory, and sensors that err in every way."""
    run = run_over(3.0 + np.cumsum(random.uniform(0.003, 0.02, 8)), with_rates=with_rates)
    motion = random.normal(0, 1, (2, 8, N))
    params = {effect.name: drawn_params(effect, random) for effect in structure().sensors}
    return run, Trajectory(*motion, 0 * motion[0], 0 * motion[0]), params


@pytest.mark.parametrize(("effect", "name"), SENSORS, ids=[f"{effect.name}.{name}" for effect, name in SENSORS])
@pytest.mark.parametrize("with_rates", [False, True])
def test_a_sensor_derivative_is_the_derivative_of_what_is_read(effect, name: str, with_rates: bool) -> None:  # type: ignore[no-untyped-def]
    """All sensors measure one after the other."""
    run, way, params = sensed(np.random.default_rng(len(name)), with_rates)
    scene = scene_along(drawn_motion(np.random.default_rng(0), 7), structure().values, params)
    scene = replace(scene, run=run, way=way)

    def read(values: np.ndarray) -> np.ndarray:
        seen = Reading(run.times, way.q, way.w, float(run.times[0]))
        for each in structure().sensors:
            mine = params[each.name] if each is not effect else {**params[each.name], name: values}
            seen = each.measure(seen, mine)
        return np.hstack([seen.theta, seen.theta_rate]) if with_rates else seen.theta

    at = params[effect.name][name]
    found = SensorSensitivity(effect.name, name, at.size).reading(scene)
    expected = differences(read, at, 1e-3)
    assert np.any(expected)
    np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-6 * np.abs(expected).max())


@LAW
@given(SEEDS, st.booleans())
def test_readings_move_with_the_trajectory_as_their_matrix_says(seed: int, with_rates: bool) -> None:
    """Sensors are affine in the motion, the same way in every row."""
    random = np.random.default_rng(seed)
    run, way, params = sensed(random, with_rates)
    by = random.normal(0, 1, (2, 8, N))
    seen = structure().measurement(run, way, params)
    moved = structure().readings(run, way.q + by[0], way.w + by[1], params)
    np.testing.assert_allclose(seen.expected + np.hstack(list(by)) @ seen.H.T, moved, rtol=1e-9, atol=1e-9)


@LAW
@given(SEEDS)
def test_torque_in_the_substeps_adds_up_at_the_interval_s_end(seed: int) -> None:
    random = np.random.default_rng(seed)
    run = run_over(np.cumsum(random.uniform(0.003, 0.02, 6)))
    rows = int(run.first[-1])
    W, torque = random.normal(0, 1, (rows, 2 * N, N)), random.normal(0, 1, (rows, N, 4))
    found = to_states(W, torque, run.first)
    each = np.einsum("rin,rnp->rip", W, torque)
    expected = [each[a:b].sum(axis=0) for a, b in zip(run.first[:-1], run.first[1:], strict=True)]
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


def test_columns_side_by_side_are_each_by_itself() -> None:
    """Those of torque leave the readings alone, those of readings the torque."""
    random = np.random.default_rng(0)
    params = {effect.name: drawn_params(effect, random) for effect in structure().sensors}
    scene = scene_along(drawn_motion(random, ROWS), drawn_values(random), params)
    ones = [
        Sensitivity(directions_of("mass")),
        SensorSensitivity("angle_offset", "offset", N),
        Change({"stiffness": 1.2}),
    ]
    torque, reading = assembled(ones, scene)
    assert torque.shape == (ROWS, N, 2 * N + 1)
    np.testing.assert_array_equal(torque[:, :, :N], ones[0].torque(scene))
    np.testing.assert_array_equal(torque[:, :, 2 * N :], ones[2].torque(scene))
    np.testing.assert_array_equal(reading[:, :, N : 2 * N], ones[1].reading(scene))
    assert not np.any(torque[:, :, N : 2 * N])
    assert not np.any(reading[:, :, :N])
    assert not np.any(reading[:, :, 2 * N :])
