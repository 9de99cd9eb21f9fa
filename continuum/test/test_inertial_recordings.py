"""Streams of sensors on one grid, and angles of whole recordings."""

from dataclasses import replace

import numpy as np
import pytest
from inertial_arm import (
    PERFECT,
    RELEASE,
    REST,
    Motion,
    N,
    SensorModel,
    calibrated,
    pull_and_release,
    rms,
    sensed,
    with_losses,
)

from continuum.arrays import Array
from continuum.errors import InvalidValueError, MeasurementError
from continuum.inertial.common_clock import check_common_clock
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.recorded_angles import recorded_angles
from continuum.inertial.time_grid import Stream, on_one_grid

pytestmark = pytest.mark.slow

STORED = 120.0
AT_120 = EstimatorSettings(period=1 / STORED)


@pytest.fixture(scope="module")
def motion() -> Motion:
    return pull_and_release()


@pytest.fixture(scope="module")
def recording(motion: Motion) -> ImuRecording:
    return sensed(motion, STORED, SensorModel(), seed=3)[0]


def streams(recording: ImuRecording) -> list[Stream]:
    return [
        Stream(f"s{i}", recording.times, recording.rates[:, i], recording.forces[:, i], recording.clipped[:, i])
        for i in range(recording.n_sensors)
    ]


def some(stream: Stream, rows: Array | slice) -> Stream:
    """Of its readings."""
    return Stream(stream.name, stream.times[rows], stream.rates[rows], stream.forces[rows], stream.clipped[rows])


def off_phase(motion: Motion, by: int) -> ImuRecording:
    """Readings of the same sensors at instants that are ``by`` fine steps later."""
    later = Motion(motion.times[by:], motion.theta[by:], motion.rate[by:])
    return sensed(later, STORED, SensorModel(rate_noise=0.0, force_noise=0.0), seed=3)[0]


def test_streams_of_the_same_instants_come_through(recording: ImuRecording) -> None:
    found = on_one_grid(streams(recording))
    np.testing.assert_allclose(found.times, recording.times, atol=1e-9)
    np.testing.assert_allclose(found.rates, recording.rates, atol=1e-8)
    np.testing.assert_allclose(found.forces, recording.forces, atol=1e-6)
    assert found.valid.all()


@pytest.mark.parametrize("by", [1, 4, 7])
def test_instants_in_between_give_the_means_of_the_grid(motion: Motion, by: int) -> None:
    plain, late = off_phase(motion, 0), off_phase(motion, by)
    first, second = streams(plain)[4], streams(late)[4]
    found = on_one_grid([first, second])
    turn = np.cumsum(found.rates[:, 1] - found.rates[:, 0], axis=0) / STORED  # of the same link, by both streams
    assert np.degrees(np.abs(turn).max()) < 0.5  # where the cable is let go within half a period
    assert np.degrees(np.sqrt(np.mean(turn**2))) < 0.05


def test_what_a_stream_misses_is_not_valid_and_the_rest_is(recording: ImuRecording) -> None:
    whole = streams(recording)
    keep = np.ones(recording.times.size, dtype=bool)
    keep[[400, 900, 901, 902]] = False
    whole[2] = some(whole[2], keep)
    found = on_one_grid(whole)
    assert np.flatnonzero(~found.valid[:, 2]).tolist() == [400, 900, 901, 902]
    assert found.valid[:, [0, 1, 3, 4]].all()


def test_clips_are_carried_over(recording: ImuRecording) -> None:
    whole = streams(recording)
    clipped = np.zeros(recording.times.size, dtype=bool)
    clipped[777] = True
    whole[1] = replace(whole[1], clipped=clipped)
    assert np.flatnonzero(on_one_grid(whole).clipped[:, 1]).tolist() == [777]
    whole[0] = replace(whole[0], times=whole[0].times + 0.4 / STORED)  # whose instants are the grid's now
    found = on_one_grid(whole)
    at = np.flatnonzero(found.clipped[:, 1])
    assert at.size == 2
    assert abs(found.times[at].mean() - recording.times[777]) < 1 / STORED


def test_streams_that_do_not_belong_together_are_refused(recording: ImuRecording) -> None:
    whole = streams(recording)
    with pytest.raises(MeasurementError, match="no time is common to all sensors"):
        on_one_grid([whole[0], replace(whole[1], times=whole[1].times + 100)])
    with pytest.raises(MeasurementError, match=r"s1 has 60\.0 readings a second, s0 120\.0"):
        on_one_grid([whole[0], some(whole[1], slice(None, None, 2))])
    with pytest.raises(MeasurementError, match="s1 has only 2 readings"):
        on_one_grid([whole[0], some(whole[1], slice(2))])


def test_clocks_that_were_not_synchronised_are_noticed(recording: ImuRecording) -> None:
    check_common_clock(recording)
    check_common_clock(recording.part(0.0, REST - 0.5))  # at rest there is nothing to notice
    rates = recording.rates.copy()
    rates[:, 1] = np.roll(rates[:, 1], round(0.5 * STORED), axis=0)
    with pytest.raises(MeasurementError, match=r"move at different times \(.*synchronised"):
        check_common_clock(replace(recording, rates=rates))


def angle_errors(recording: ImuRecording, motion: Motion) -> Array:
    """Of a whole recording, (n_times, n) [degrees]."""
    found = recorded_angles(recording, calibrated(recording), AT_120)
    assert np.array_equal(np.isfinite(found.theta), found.good)
    assert np.array_equal(np.isfinite(found.theta_rate), found.good)
    return np.degrees(found.theta - motion.at(recording.times)[0])


def test_angles_of_a_whole_recording(motion: Motion, recording: ImuRecording) -> None:
    off = angle_errors(recording, motion)
    swing = (recording.times > RELEASE) & (recording.times < RELEASE + 2)
    assert np.isfinite(off).all()
    assert rms(off[swing]).max() < 0.5
    assert rms(off[~swing]).max() < 0.3


def test_both_ways_belong_to_the_same_instant(motion: Motion) -> None:
    assert np.abs(angle_errors(sensed(motion, STORED, PERFECT, seed=0)[0], motion)).max() < 0.2


def test_rest_at_either_end_is_enough(motion: Motion, recording: ImuRecording) -> None:
    calibration = calibrated(recording)
    for begin, end in ((RELEASE + 0.1, 99.0), (0.0, RELEASE + 0.4)):
        cut = recording.part(begin, end)
        found = recorded_angles(cut, calibration, AT_120)
        off = np.degrees(found.theta - motion.at(cut.times)[0])
        assert np.isfinite(off).all()
        assert rms(off).max() < 0.5


def test_gaps_offline_give_nothing_wrong(motion: Motion, recording: ImuRecording) -> None:
    rng = np.random.default_rng(5)
    lost = rng.random((recording.times.size, N)) < 0.005
    lost[int((RELEASE + 0.2) * STORED) : int((RELEASE + 0.3) * STORED), 3] = True
    off = angle_errors(with_losses(recording, lost), motion)
    assert np.nanmax(np.abs(off)) < 1.0
    assert rms(off).max() < 0.5
    assert not np.isfinite(off[lost]).any()


def test_rates_at_instants_are_refused_offline(recording: ImuRecording) -> None:
    with pytest.raises(InvalidValueError, match="rates_are_means"):
        recorded_angles(recording, calibrated(recording), replace(AT_120, rates_are_means=False))
