"""The plant's sensors: errors of the stated size, correlated between neighbours, rates that are the angles' rates."""

import numpy as np

from blind.mujoco_plant import EFFECTS, Effect, Motion, Noise
from blind.mujoco_plant.machine import KEPT, RATE
from blind.mujoco_plant.sensors import ORDINARY, Reading

ROWS = 481
TIME = np.arange((ROWS - 1) * KEPT + 1) / (RATE * KEPT)
PACE = 2 * np.pi * np.array([0.5, 0.7, 0.9, 1.1, 1.3])
SWING = Motion(TIME, np.sin(np.outer(TIME, PACE)), PACE * np.cos(np.outer(TIME, PACE)), ROWS)
STILL = Motion(TIME, np.zeros((TIME.size, 5)), np.zeros((TIME.size, 5)), ROWS)


def read(motion: Motion, noise: Noise, seed: int, *effects: Effect) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return Reading(5, effects, rng).take(motion, noise, rng)


def test_rates_are_those_of_the_angles() -> None:
    angle, rate = read(SWING, Noise(), 0)
    np.testing.assert_allclose(np.gradient(angle, 1 / RATE, axis=0)[1:-1], rate[1:-1], atol=0.02)


def test_errors_have_the_stated_size() -> None:
    white = Noise(angle=0.01)
    errors = np.concatenate([read(STILL, white, seed)[0] for seed in range(10)])
    np.testing.assert_allclose(errors.std(axis=0), 0.01 * np.sqrt([1, 2, 2, 2, 2]), rtol=0.05)


def test_neighbours_errors_are_correlated() -> None:
    errors = np.concatenate([read(STILL, ORDINARY, seed)[1] for seed in range(10)])
    correlation = np.corrcoef(errors.T)
    np.testing.assert_allclose(np.diag(correlation, 1)[1:], -0.5, atol=0.05)
    np.testing.assert_allclose(np.diag(correlation, 2), 0.0, atol=0.05)


def test_an_integrated_gyro_wanders() -> None:
    """By its noise times the square root of the number of rows."""
    gyro = Noise(gyro=0.02)
    ends = np.array([read(STILL, gyro, seed)[0][-1, 0] for seed in range(400)])
    np.testing.assert_allclose(ends.std(), 0.02 * np.sqrt(ROWS - 1) / RATE, rtol=0.12)


def test_drift_is_in_rates_and_angles_alike() -> None:
    angle, rate = read(STILL, Noise(), 3, EFFECTS["gyro_drift"](0.02))
    np.testing.assert_allclose(angle[-1], rate[0] * (ROWS - 1) / RATE, rtol=1e-9)
    np.testing.assert_array_less(0.01 - 1e-12, np.abs(np.cumsum(rate[0])))


def test_a_delay_shifts_rows() -> None:
    late = read(SWING, Noise(), 0, EFFECTS["sensor_delay"](3 / RATE))[0]
    np.testing.assert_allclose(late[3:], read(SWING, Noise(), 0)[0][:-3], atol=1e-9)


def test_one_sensors_gain_is_seen_at_two_joints() -> None:
    wrong = read(SWING, Noise(), 0, EFFECTS["sensor_scale"](0.1, 2))[0] - read(SWING, Noise(), 0)[0]
    link = SWING.angle[::KEPT, 1]
    np.testing.assert_allclose(wrong, 0.1 * np.outer(link, [0, 1, -1, 0, 0]), atol=1e-12)


def test_offsets_differ_by_joint_and_recording() -> None:
    one, other = (read(STILL, Noise(), seed, EFFECTS["angle_offset"](0.03))[0] for seed in (1, 2))
    assert np.ptp(one, axis=0).max() == 0.0
    assert np.all(np.abs(one[0]) >= 0.015)
    assert np.abs(one[0] - other[0]).min() > 0
