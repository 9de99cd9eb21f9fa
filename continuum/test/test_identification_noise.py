"""Sensor noise whose size is known, on a smooth motion: what is estimated of it without a model of the arm."""

import numpy as np
import pytest

from continuum.identification.noise import Channel, Noise, SensorKnowledge, estimate_noise
from continuum.recordings.recording import Recording

JOINTS, SECONDS, RATE = 3, 1.6, 120
T = np.arange(round(SECONDS * RATE)) / RATE
PHASE = np.arange(JOINTS)
DECAY = np.exp(-2 * T[:, None])
MOTION = 0.4 * DECAY * np.cos(9 * T[:, None] + PHASE)
MOTION_RATE = -0.4 * DECAY * (2 * np.cos(9 * T[:, None] + PHASE) + 9 * np.sin(9 * T[:, None] + PHASE))
ANGLE, GYRO = np.deg2rad(0.3), np.deg2rad(1.5)
NEIGHBOURS = np.array([[1.0, -0.5, 0.0], [-0.5, 1.0, -0.5], [0.0, -0.5, 1.0]])
"""Correlation of joints whose angles are differences of neighbouring sensors."""


def runs(
    seed: int,
    count: int = 6,
    angle: float = ANGLE,
    gyro: float | None = GYRO,
    joints: np.ndarray | None = None,
    wander: float = 0.0,
) -> list[Recording]:
    """Runs of the same motion, each with noise of its own; the wander keeps alike for a second."""
    random, between = np.random.default_rng(seed), np.eye(JOINTS) if joints is None else joints
    mixed = np.linalg.cholesky(between).T
    slow = np.linalg.cholesky(np.exp(-np.abs(T[:, None] - T)) + 1e-12 * np.eye(T.size))
    found = []
    for i in range(count):
        theta = MOTION + angle * random.normal(size=MOTION.shape) @ mixed
        theta = theta + wander * slow @ random.normal(size=MOTION.shape)
        rate = None if gyro is None else MOTION_RATE + gyro * random.normal(size=MOTION.shape) @ mixed
        found.append(Recording(f"run {i}", T, theta, rate))
    return found


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("size", [0.5, 1.0, 4.0])
def test_white_noise_is_found_to_a_fifth(seed: int, size: float) -> None:
    noise = estimate_noise(runs(seed, angle=size * ANGLE, gyro=size * GYRO))
    assert noise.rate is not None
    np.testing.assert_allclose(noise.angle.white, size * ANGLE, rtol=0.2)
    np.testing.assert_allclose(noise.rate.white, size * GYRO, rtol=0.2)


@pytest.mark.parametrize("seed", range(4))
def test_white_noise_without_rates(seed: int) -> None:
    noise = estimate_noise(runs(seed, gyro=None))
    assert noise.rate is None
    np.testing.assert_allclose(noise.angle.white, ANGLE, rtol=0.2)


def test_joints_of_which_one_is_noisier() -> None:
    loud = np.diag([1.0, 9.0, 1.0])
    np.testing.assert_allclose(estimate_noise(runs(0, joints=loud)).angle.white, ANGLE * np.array([1, 3, 1]), rtol=0.2)


@pytest.mark.parametrize("seed", range(4))
def test_correlation_of_the_joints_is_found(seed: int) -> None:
    noise = estimate_noise(runs(seed, joints=NEIGHBOURS))
    assert noise.rate is not None
    for channel in (noise.angle, noise.rate):
        found = channel.joints / np.outer(channel.white, channel.white)
        np.testing.assert_allclose(found, NEIGHBOURS, atol=0.12)


@pytest.mark.parametrize("size", [1.0, 3.0])
def test_what_wanders_is_seen_beside_the_rates(size: float) -> None:
    """The estimate of one seed scatters; their mean is near."""
    found = []
    for seed in range(6):
        noise = estimate_noise(runs(seed, wander=size * ANGLE))
        found.append(np.sqrt(noise.angle.slow) * np.mean(noise.angle.white) / ANGLE)
    assert np.mean(found) == pytest.approx(size, rel=0.2)


def test_where_nothing_wanders_none_is_found() -> None:
    noise = estimate_noise(runs(1, gyro=np.deg2rad(0.3)))
    assert np.sqrt(noise.angle.slow) * np.mean(noise.angle.white) < 0.2 * ANGLE


def test_what_the_rates_cannot_tell_is_taken_from_what_is_known() -> None:
    known = SensorKnowledge(wander=np.deg2rad(0.7), wander_time=2.5, rate_bias=np.deg2rad(0.4))
    blind, seeing = estimate_noise(runs(0, gyro=None), known), estimate_noise(runs(0), known)
    assert np.sqrt(blind.angle.slow) * np.mean(blind.angle.white) == pytest.approx(known.wander, rel=0.05)
    assert blind.angle.slow_time == known.wander_time
    assert seeing.rate is not None
    assert np.sqrt(seeing.rate.slow) * np.mean(seeing.rate.white) == pytest.approx(known.rate_bias, rel=0.05)
    assert seeing.rate.slow_time == np.inf


def test_sensors_without_noise_err_by_the_floor() -> None:
    noise = estimate_noise(runs(0, angle=0.0, gyro=np.deg2rad(0.2)))
    assert noise.rate is not None
    for channel in (noise.angle, noise.rate):
        assert np.all(channel.white >= np.deg2rad(0.1) * 0.99)
        assert np.all(channel.white < np.deg2rad(0.5))


def test_covariance_in_time_is_that_of_its_parts() -> None:
    """White, slow, walk and ramp, drawn often: the covariance of the draws is the one that is stated."""
    random, times = np.random.default_rng(3), np.array([0.0, 0.1, 0.25, 0.6, 1.0])
    channel = Channel(np.eye(1), slow=2.0, slow_time=0.5, walk=3.0, ramp=4.0)
    draws = 200_000
    steps = np.sqrt(np.diff(times)) * random.normal(size=(draws, 4))
    walk = np.sqrt(3.0) * np.concatenate([np.zeros((draws, 1)), np.cumsum(steps, axis=1)], axis=1)
    slow = np.zeros((draws, times.size))
    slow[:, 0] = random.normal(size=draws)
    for i, kept in enumerate(np.exp(-np.diff(times) / 0.5)):
        slow[:, i + 1] = kept * slow[:, i] + np.sqrt(1 - kept**2) * random.normal(size=draws)
    ramp = 2.0 * random.normal(size=(draws, 1)) * times
    errors = random.normal(size=slow.shape) + np.sqrt(2.0) * slow + walk + ramp
    np.testing.assert_allclose(np.cov(errors.T), channel.in_time(times), rtol=0, atol=0.07)


def test_rates_that_no_sensor_has_are_those_of_a_simulation() -> None:
    """Their error is that of another simulation; a single joint that is read by a sensor makes them measured."""
    time = np.arange(240) / 120
    smooth = np.column_stack([np.sin(3 * time), np.cos(2 * time)])
    random = np.random.default_rng(3)

    def noise_of(loudness: tuple[float, float]) -> Noise:
        rates = smooth + np.deg2rad(loudness) * random.normal(size=smooth.shape)
        return estimate_noise([Recording("run", time, smooth, rates)])

    simulated, read = noise_of((0.0, 0.05)), noise_of((0.0, 0.3))
    assert simulated.is_simulated
    assert not read.is_simulated
    assert simulated.rate is not None
    assert read.rate is not None
    np.testing.assert_allclose(np.rad2deg(simulated.rate.white), 0.5)
    np.testing.assert_allclose(np.rad2deg(read.rate.white), [0.1, 0.3], rtol=0.3)
