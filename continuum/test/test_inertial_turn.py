"""Angles by rates alone: the bias that gravity shows of a link in motion, and what it does not show."""

from dataclasses import replace

import numpy as np
import pytest
from inertial_arm import DEG, with_losses
from turning_sensor import Turning, back_and_forth, sensed_turn

from continuum.arrays import Array
from continuum.errors import InvalidValueError, MeasurementError
from continuum.inertial.bias_in_motion import BiasInMotion, bias_in_motion
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.recorded_turn import recorded_turn

ZERO = np.zeros((1, 3))
UNKNOWN = 0.5 * DEG


def found(sensor: Turning, seed: int, duration: float = 60.0, turn: float = 180 * DEG) -> tuple[BiasInMotion, Array]:
    times, angle = back_and_forth(duration, turn)
    recording, axis = sensed_turn(times, angle, sensor, np.random.default_rng(seed))
    return bias_in_motion(recording, axis, ZERO, UNKNOWN), axis


@pytest.mark.parametrize("tilt", [0.5, 5.0, 45.0, 90.0])
@pytest.mark.parametrize("bias", [-0.4, 0.02, 1.5])
def test_gravity_across_the_axis_shows_the_bias(tilt: float, bias: float) -> None:
    result, axis = found(Turning(tilt=tilt * DEG, bias=bias * DEG), seed=int(tilt))
    assert abs(np.sum(result.bias * axis) - bias * DEG) < 4 * result.error[0]
    assert result.error[0] < 0.06 * DEG * 0.5 / tilt


def test_a_sensor_far_from_the_axis_is_none_the_worse() -> None:
    times, angle = back_and_forth(40.0, time=0.5)
    for seed in range(3):
        errors = []
        for lever in (0.0, 0.3):
            sensor = Turning(tilt=1 * DEG, lever=lever)
            recording, axis = sensed_turn(times, angle, sensor, np.random.default_rng(seed))
            result = bias_in_motion(recording, axis, ZERO, UNKNOWN)
            assert abs(np.sum(result.bias * axis) - sensor.bias) < 4 * result.error[0]
            errors.append(result.error[0])
        assert errors[1] < 1.2 * errors[0]


@pytest.mark.parametrize("turn", [0.0, 180 * DEG])
def test_where_gravity_shows_nothing_nothing_is_made_up(turn: float) -> None:
    """About an exactly vertical axis, and at rest about one that is horizontal."""
    for seed in range(5):
        tilt = 0.0 if turn else 90 * DEG
        result, axis = found(Turning(tilt=tilt, bias=0.0), seed, turn=turn)
        assert abs(np.sum(result.bias * axis)) < 2 * result.error[0]
        assert result.error[0] > 0.05 * DEG  # the prior's is 0.18


def test_errors_are_as_large_as_reckoned() -> None:
    """Over biases that the prior expects, from axes that show them well to axes that do not show them."""
    rng, off, reckoned = np.random.default_rng(0), [], []
    for seed in range(60):
        size = np.exp(rng.uniform(np.log(0.01 * DEG), np.log(UNKNOWN)))
        sensor = Turning(tilt=[0, 0.1, 0.3, 1][seed % 4] * DEG, bias=rng.normal(scale=size))
        result, axis = found(sensor, seed, 40.0)
        off.append(float(np.sum(result.bias * axis) - sensor.bias))
        reckoned.append(result.error[0])
    assert 0.6 < np.mean(np.square(off)) / np.mean(np.square(reckoned)) < 1.6


def test_time_backwards_turns_the_bias() -> None:
    times, angle = back_and_forth(40.0)
    recording, axis = sensed_turn(times, angle, Turning(tilt=2 * DEG), np.random.default_rng(3))
    back = replace(recording, rates=-recording.rates[::-1], forces=recording.forces[::-1])
    ahead, behind = (bias_in_motion(r, axis, ZERO, UNKNOWN) for r in (recording, back))
    np.testing.assert_allclose(behind.bias, -ahead.bias, rtol=1e-6)
    np.testing.assert_allclose(behind.error, ahead.error, rtol=1e-6)


def test_a_prior_that_is_off_is_corrected_about_the_axis_only() -> None:
    times, angle = back_and_forth(40.0)
    recording, axis = sensed_turn(times, angle, Turning(tilt=20 * DEG), np.random.default_rng(4))
    prior = np.array([[0.3, -0.2, 0.4]]) * DEG
    at_zero, at_prior = (bias_in_motion(recording, axis, p, UNKNOWN).bias for p in (ZERO, prior))
    np.testing.assert_allclose(np.sum((at_prior - at_zero) * axis), 0, atol=1e-3 * DEG)
    np.testing.assert_allclose(np.cross(at_prior - prior, axis), 0, atol=1e-12)


def test_noise_free_readings_give_the_bias_itself() -> None:
    exact = Turning(tilt=30 * DEG, bias=0.3 * DEG, rate_noise=0.0, force_noise=0.0)
    result, axis = found(exact, seed=5)
    assert abs(np.sum(result.bias * axis) - exact.bias) < 1e-4 * DEG


def test_another_uncertainty_than_above_a_calibrated_sensors_is_refused() -> None:
    times, angle = back_and_forth(10.0)
    recording, axis = sensed_turn(times, angle, Turning(), np.random.default_rng(0))
    for wrong in (0.0, 0.005 * DEG, np.nan, np.inf):
        with pytest.raises(InvalidValueError, match="uncertainty"):
            bias_in_motion(recording, axis, ZERO, wrong)
    with pytest.raises(MeasurementError, match="sensor 1 has only 3 good readings"):
        bias_in_motion(recording.part(0.0, 0.02), axis, ZERO, UNKNOWN)


def turned(sensor: Turning, rest: float, first_turn: int = 1, seed: int = 0) -> tuple[Array, Array, ImuRecording]:
    """Errors of the angle and of the integral of unchanged rates [degrees], and the recording."""
    times, angle = back_and_forth(120.0)
    angle = np.interp(times - rest, times, angle)
    recording, axis = sensed_turn(times, angle * first_turn, sensor, np.random.default_rng(seed))
    result = recorded_turn(recording, first_turn)
    np.testing.assert_allclose(np.abs(np.sum(result.axis * axis)), 1, atol=1e-4)
    return np.degrees(result.angle[:, 0] - angle * first_turn), sensor.bias / DEG * times, recording


@pytest.mark.parametrize("first_turn", [1, -1])
def test_the_angle_about_an_almost_vertical_axis_drifts_less_without_rest(first_turn: int) -> None:
    off, drift, _ = turned(Turning(tilt=1 * DEG, bias=0.2 * DEG), 0.0, first_turn)
    assert np.abs(off).max() < 0.1 * np.abs(drift).max()


def test_a_rest_gives_the_bias_about_a_vertical_axis() -> None:
    off, drift, _ = turned(Turning(tilt=0.0, bias=0.2 * DEG), 5.0)
    assert np.abs(off).max() < 0.2 * np.abs(drift).max()


def test_missing_readings_are_bridged_and_clipped_ones_refused() -> None:
    sensor = Turning(tilt=5 * DEG)
    whole, _, recording = turned(sensor, 0.0)
    lost = np.zeros((recording.times.size, 1), dtype=bool)
    lost[np.random.default_rng(1).integers(1, lost.size, 300)] = True
    gone = with_losses(replace(recording, rates=np.where(lost[:, :, None], np.nan, recording.rates)), lost)
    difference = np.degrees(recorded_turn(gone).angle - recorded_turn(recording).angle)
    assert np.abs(difference).max() < 0.2 + np.abs(whole).max()
    with pytest.raises(MeasurementError, match="sensor 1 clipped"):
        recorded_turn(replace(recording, clipped=lost))
