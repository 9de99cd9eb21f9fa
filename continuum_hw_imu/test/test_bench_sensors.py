"""The sensor model: exact where it is to be, and wrong by as much as it says."""

import numpy as np
import pytest

from continuum_hw_imu.emulator.sensor_model import SensorModel
from continuum_hw_imu.protocol.messages.imu import PRESENT, RATE_STEP
from continuum_hw_imu.sensor_quality import SensorQuality

T = 1 / 60
STILL = np.zeros(5)
DOWN = np.tile([0.0, 0.0, -9.81], (5, 1))


def sensors(quality: SensorQuality, seed: int = 1) -> SensorModel:
    return SensorModel(5, quality, np.random.default_rng(seed))


def test_perfect_ones_are_exact_about_the_joints_axis():
    turns = np.array([1.0, -2.0, 3.0, 0.5, 0.0])
    frame = sensors(SensorQuality().perfect()).frame(3, turns, DOWN, T)
    np.testing.assert_allclose(frame.angular_rates[:, 1], turns, atol=np.radians(RATE_STEP))
    np.testing.assert_array_equal(frame.angular_rates[:, ::2], 0.0)
    np.testing.assert_allclose(frame.specific_forces, DOWN, atol=0.005)
    assert frame.present.all()
    assert not frame.clipped.any()


def test_errors_are_as_large_as_they_are_said_to_be():
    quality = SensorQuality(bias_walk=0.0)
    model = sensors(quality)
    frames = [model.frame(k, STILL, DOWN, T) for k in range(3000)]
    rates, forces = (np.array([getattr(f, name) for f in frames]) for name in ("angular_rates", "specific_forces"))
    quantised = np.hypot(quality.rate_noise, np.radians(RATE_STEP) / np.sqrt(12))
    np.testing.assert_allclose(rates.std(axis=0), quantised, rtol=0.1)
    np.testing.assert_allclose(forces.std(axis=0), np.hypot(quality.force_noise, 0.005 / np.sqrt(12)), rtol=0.1)
    assert rates.mean(axis=0).std() == pytest.approx(quality.rate_bias, rel=0.5)
    lengths = np.linalg.norm(forces.mean(axis=0), axis=1)
    np.testing.assert_allclose(lengths, 9.81, atol=4 * quality.force_bias)


def test_mounting_turns_rates_and_forces_alike():
    model = sensors(SensorQuality(0.0, 0.0, 0.0, 0.0, 0.0, mounting=0.2))
    frame = model.frame(0, np.full(5, 10.0), np.tile([0.0, 9.81, 0.0], (5, 1)), T)
    along = frame.angular_rates / np.linalg.norm(frame.angular_rates, axis=1, keepdims=True)
    np.testing.assert_allclose(frame.specific_forces / 9.81, along, atol=2e-3)
    assert np.all(along[:, 1] < 0.9999)


def test_a_lost_sensor_gives_nothing():
    model = sensors(SensorQuality())
    model.lost.add(2)
    frame = model.frame(0, np.full(5, 3.0), DOWN, T)
    assert frame.present.tolist() == [True, True, False, True, True]
    assert frame.readings[2] == (0,) * 7


@pytest.mark.parametrize(("turn", "clipped"), [(0.3, False), (0.4, True), (-0.4, True)])
def test_a_narrowed_sensor_clips_and_says_so(turn, clipped):
    model = sensors(SensorQuality().perfect())
    model.narrowed[1] = np.radians(20.0)
    frame = model.frame(0, np.full(5, turn), DOWN, T)
    assert frame.clipped.tolist() == [False, clipped, False, False, False]
    assert abs(frame.angular_rates[1, 1]) == pytest.approx(min(abs(turn), np.radians(20.0)), abs=2e-3)
    assert bool(frame.readings[1].flags & 0x02) == clipped
    model.widen(1)
    assert not model.frame(0, np.full(5, turn), DOWN, T).clipped.any()


def test_too_hard_a_knock_clips():
    frame = sensors(SensorQuality().perfect()).frame(0, STILL, np.tile([200.0, 0.0, 0.0], (5, 1)), T)
    assert [reading.flags for reading in frame.readings] == [PRESENT | 0x08] * 5
