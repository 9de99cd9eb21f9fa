"""The online estimator on a synthetic arm: accuracy, and nothing wrong given as good whatever is lost."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inertial_arm import (
    DEG,
    PERFECT,
    RELEASE,
    REST,
    Motion,
    N,
    SensorModel,
    calibrated,
    errors,
    estimated,
    pull_and_release,
    rms,
    sensed,
    with_losses,
)
from inertial_faults import KINDS, losses

from continuum.errors import InvalidValueError
from continuum.inertial.angle_estimator import AngleEstimator
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.imu_sample import ImuSample
from continuum.inertial.integrated_rate import Liveliness, turn_since

pytestmark = pytest.mark.slow

LIVE = 60.0
ANY = np.random.default_rng
SOON = 1.0  # s in which a link at rest is found again


@pytest.fixture(scope="module")
def motion() -> Motion:
    return pull_and_release()


@pytest.fixture(scope="module")
def recording(motion: Motion) -> ImuRecording:
    return sensed(motion, LIVE, SensorModel(), seed=1)[0]


@pytest.mark.parametrize("seed", range(2))
def test_release_within_half_a_degree_and_rest_within_three_tenths(motion: Motion, seed: int) -> None:
    recording, _ = sensed(motion, LIVE, SensorModel(), seed)
    estimates = estimated(recording, calibrated(recording))
    off, times = errors(estimates, motion), recording.times
    swing = (times > RELEASE) & (times < RELEASE + 2)
    assert np.ptp(motion.theta[:, -1]) > 25 * DEG
    assert np.isfinite(off[times > SOON]).all()
    assert rms(off[swing]).max() < 0.5
    for rest in ((times > SOON) & (times < REST), (times > RELEASE - 1) & (times < RELEASE), times > times[-1] - 2):
        assert rms(off[rest]).max() < 0.3


def test_perfect_sensors_give_the_truth(motion: Motion) -> None:
    recording, _ = sensed(motion, LIVE, PERFECT, seed=0)
    off = errors(estimated(recording, calibrated(recording)), motion)
    assert np.nanmax(np.abs(off)) < 0.1  # the accelerometer's word on slow pulling, with the arm's jerks


def test_rates_are_those_of_the_joints(motion: Motion, recording: ImuRecording) -> None:
    estimates = estimated(recording, calibrated(recording))
    _, rate = motion.at(recording.times - 0.5 / LIVE)  # means over the period before
    off = np.degrees(np.array([estimate.rates for estimate in estimates])[100:] - rate[100:])
    assert rms(off).max() < 0.02 * np.degrees(np.abs(motion.rate).max())


def test_rates_at_instants_have_their_own_integral(motion: Motion) -> None:
    recording, _ = sensed(motion, 120.0, SensorModel(means=False), seed=1)
    found = calibrated(recording)
    off = [
        rms(errors(estimated(recording, found, EstimatorSettings(1 / 120, rates_are_means=means)), motion)).max()
        for means in (False, True)
    ]
    assert off[0] < 0.2
    assert off[0] < off[1]


def test_a_bias_that_comes_after_the_calibration_is_learned_at_rest(motion: Motion, recording: ImuRecording) -> None:
    found = calibrated(recording)
    signs = np.array([1, -1, 1, -1, 1])[:, None]
    estimator = AngleEstimator(replace(found, bias=found.bias + 0.05 * DEG * signs * found.axis))
    rest = list(recording.part(0.5, REST - 0.5).samples())
    off = [
        np.degrees(estimator.update(replace(rest[i % len(rest)], time=i / LIVE)).angles) for i in range(120 * int(LIVE))
    ]
    seconds = np.array(off[60:]).reshape(-1, 60, N).mean(axis=1)
    assert np.abs(seconds).max() < 0.15
    assert np.abs(seconds[-20:]).mean() < 0.5 * np.abs(seconds[5:25]).mean()


def test_nothing_is_known_before_the_first_rest(motion: Motion, recording: ImuRecording) -> None:
    found = calibrated(recording)
    swinging = recording.part(RELEASE + 0.05, 99.0)
    estimates = estimated(swinging, found)
    first = next(i for i, estimate in enumerate(estimates) if estimate.good.any())
    assert swinging.times[first] > RELEASE + 0.8
    assert "sensor 1 waits for rest" in estimates[0].why_not[0]
    assert np.nanmax(np.abs(errors(estimates, motion))) < 1.0


@pytest.mark.parametrize("kind", KINDS)
def test_no_wrong_angle_is_good(motion: Motion, recording: ImuRecording, kind: str) -> None:
    found = calibrated(recording)
    troubled = losses(kind, recording.part(RELEASE - 4, RELEASE + 6), ANY([0, KINDS.index(kind)]))
    estimates = estimated(troubled, found)
    off = errors(estimates, motion)
    assert np.nanmax(np.abs(off)) < 1.0
    assert rms(off).max() < 0.5
    assert np.array_equal(np.isfinite(off), [estimate.good for estimate in estimates])
    assert np.isfinite(off[-60:]).all()  # found again


def test_a_long_gap_in_a_swing_is_not_bridged(motion: Motion, recording: ImuRecording) -> None:
    gap = (recording.times > RELEASE + 0.1) & (recording.times < RELEASE + 0.3)
    estimates = estimated(with_losses(recording, gap), calibrated(recording))
    after = [estimate for estimate in estimates if RELEASE + 0.3 <= estimate.time < RELEASE + 0.6]
    assert not any(estimate.good.any() for estimate in after)
    assert after[0].why_not[0] == "sensor 1 waits for rest"


@pytest.mark.parametrize(("gap", "bridged"), [(0.05, True), (0.2, False)])
def test_a_gap_at_rest_is_bridged_if_nothing_can_have_happened(motion: Motion, gap: float, bridged: bool) -> None:
    recording, _ = sensed(motion, LIVE, PERFECT, seed=0)
    lost = (recording.times > 2.0) & (recording.times < 2.0 + gap)
    estimates = estimated(with_losses(recording, lost).part(0.0, 3.0), calibrated(recording))
    after = next(estimate for estimate in estimates if estimate.time > 2.0)
    assert after.good.tolist() == [bridged] * N


@given(st.integers(1, 5), st.floats(1.0, 15.0), st.floats(0.0, 2 * np.pi))
def test_the_reckoned_error_of_a_gap_covers_the_real_one(missing: int, frequency: float, phase: float) -> None:
    """Of a rate that oscillates; waves shorter than two gaps cannot be resolved."""
    omega, period = 2 * np.pi * min(frequency, LIVE / (2 * missing + 2) / 2), 1 / LIVE
    t = np.arange(-60, 20) * period
    means = np.diff(np.sin(omega * np.append(t[0] - period, t) + phase))[:, None] / period
    at, before = 70, 70 - missing - 1
    lively = Liveliness(np.zeros(1), np.zeros(1))
    for k in range(2, before + 1):
        lively = lively.after(means[k - 2 : k + 1], period, 0.5)
    real = means[before + 1 : at + 1].sum() * period
    bridged = turn_since(means[at], means[before], np.array([(missing + 1) * period]), period, means=True)
    reckoned = lively.error_of_gap(np.array([missing]), means[at] - means[before], period)
    assert abs(bridged[0] - real) <= reckoned[0] + 1e-12


def test_a_link_at_rest_is_found_again_within_a_second(recording: ImuRecording) -> None:
    gap = (recording.times > 2.0) & (recording.times < 3.0)
    estimates = estimated(with_losses(recording, gap), calibrated(recording))
    again = next(estimate.time for estimate in estimates if estimate.time > 2.5 and estimate.good.all())
    assert 3.0 < again < 3.0 + SOON


def test_a_missing_sensor_takes_its_two_joints_and_no_other(recording: ImuRecording) -> None:
    lost = np.zeros((recording.times.size, N), dtype=bool)
    lost[200, 2] = True
    estimates = estimated(with_losses(recording, lost), calibrated(recording))
    assert estimates[200].good.tolist() == [True, True, False, False, True]
    assert estimates[200].why_not[3] == "sensor 3 is missing"
    assert estimates[201].good.all()


def test_what_comes_late_or_again_changes_nothing(recording: ImuRecording) -> None:
    found = calibrated(recording)
    samples = list(recording.part(0.0, 3.0).samples())
    plain, disturbed = AngleEstimator(found), AngleEstimator(found)
    for i, sample in enumerate(samples):
        expected, seen = plain.update(sample), disturbed.update(sample)
        if i % 7 == 3:
            disturbed.update(sample)
            disturbed.update(samples[i - 2])
        np.testing.assert_array_equal(seen.angles, expected.angles)
    assert disturbed.ignored == 2 * len(range(3, len(samples), 7))


@pytest.mark.parametrize("rubbish", [np.nan, 1e300])
def test_rubbish_is_a_missing_sensor(recording: ImuRecording, rubbish: float) -> None:
    samples = list(recording.part(0.0, 3.0).samples())
    estimator = AngleEstimator(calibrated(recording))
    for sample in samples[:-1]:
        estimator.update(sample)
    rates = samples[-1].rates.copy()
    rates[1] = rubbish
    assert not estimator.update(replace(samples[-1], rates=rates)).good[1:3].any()


def test_another_number_of_sensors_is_refused(recording: ImuRecording) -> None:
    estimator = AngleEstimator(calibrated(recording))
    nothing = ImuSample(0.0, np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(3, bool), np.ones(3, bool))
    with pytest.raises(InvalidValueError, match="number of sensors is 3; allowed: 5"):
        estimator.update(nothing)


@pytest.mark.parametrize("name", ["period", "time_constant", "largest_error"])
@pytest.mark.parametrize("value", [0.0, -1.0, np.inf, np.nan])
def test_settings_are_positive(name: str, value: float) -> None:
    with pytest.raises(InvalidValueError, match=name):
        EstimatorSettings(**{name: value})
