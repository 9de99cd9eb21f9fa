"""Bias, axes and zero of the sensors: found from what they read, refused where that shows something else."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from inertial_arm import DEG, RELEASE, REST, N, SensorModel, any_rotation, pull_and_release, rotation, sensed

from continuum.arrays import Array
from continuum.errors import FileError, InvalidValueError, MeasurementError
from continuum.inertial.at_rest import bias_at_rest
from continuum.inertial.calibration import CalibrationSteps
from continuum.inertial.calibration_values import Calibration, load_calibration, save_calibration
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.inclination import inclination, turned
from continuum.inertial.rotation_axis import axes_of_motion
from continuum.inertial.stillness import rests, unrest

SEEDS = st.integers(0, 2**32 - 1)


@pytest.fixture(scope="module")
def whole() -> tuple[ImuRecording, Array]:
    return sensed(pull_and_release(), 60.0, SensorModel(), seed=2)


@pytest.fixture(scope="module")
def recording(whole: tuple[ImuRecording, Array]) -> ImuRecording:
    return whole[0]


@pytest.fixture(scope="module")
def rest(recording: ImuRecording) -> ImuRecording:
    return recording.part(0.2, REST - 0.5)


def steps(recording: ImuRecording, rest: ImuRecording) -> CalibrationSteps:
    return CalibrationSteps().with_bias(rest).with_axis(recording).with_zero(rest)


def test_bias_is_what_was_put_in(rest: ImuRecording) -> None:
    more = np.array([0.4, -0.3, 0.2]) * DEG
    found = bias_at_rest(replace(rest, rates=rest.rates + more)) - bias_at_rest(rest)
    np.testing.assert_allclose(found, np.tile(more, (N, 1)))
    quiet = replace(rest, rates=np.random.default_rng(0).normal(scale=0.05 * DEG, size=rest.rates.shape) + more)
    assert np.abs(bias_at_rest(quiet) - more).max() < 0.01 * DEG


@pytest.mark.parametrize(
    ("what", "output"),
    [
        ("swing", "sensor 3 swings: its rate changes by"),
        ("slow turn", "sensor 3 turns slowly, by"),
        ("fast turn", "sensor 3 turns at 20.0 degrees/s"),
        ("shake", "sensor 3 shakes"),
        ("missing", "sensor 3 has only 10 good readings"),
    ],
)
def test_a_moving_sensor_is_named_and_no_other(rest: ImuRecording, what: str, output: str) -> None:
    t, rates, forces, valid = rest.times - rest.times[0], rest.rates.copy(), rest.forces.copy(), rest.valid.copy()
    if what == "swing":
        rates[:, 2, 0] += 2 * DEG * np.sin(9 * t)
    elif what == "slow turn":  # as a bias to the gyroscope
        rates[:, 2, 1] += 0.1 * DEG
        forces[:, 2] = np.array([rotation(np.array([0.0, 1, 0]), -0.1 * DEG * at) @ [3, 0, 9.3] for at in t])
    elif what == "fast turn":
        rates[:, 2] = [0, 20 * DEG, 0]
    elif what == "shake":
        forces[:, 2, 0] += np.sin(60 * t)
    else:
        valid[10:, 2] = False
    moved = replace(rest, rates=rates, forces=forces, valid=valid)
    assert len(unrest(moved)) == 1
    with pytest.raises(MeasurementError, match=output):
        bias_at_rest(moved)


def test_rest_that_is_too_short_is_refused(rest: ImuRecording) -> None:
    with pytest.raises(MeasurementError, match=r"only 0\.[45]\d* s were recorded"):
        bias_at_rest(rest.part(1.0, 1.5))


def test_axes_are_found_however_the_sensors_are_mounted(whole: tuple[ImuRecording, Array], rest: ImuRecording) -> None:
    recording, axes = whole
    found = axes_of_motion(recording, bias_at_rest(rest), 1)
    assert np.degrees(np.arccos(np.clip(np.sum(found * axes, axis=1), -1, 1))).max() < 0.1
    np.testing.assert_array_equal(axes_of_motion(recording, bias_at_rest(rest), -1), -found)


def test_axes_of_a_motion_that_shows_none_are_refused(recording: ImuRecording, rest: ImuRecording) -> None:
    bias = bias_at_rest(rest)
    with pytest.raises(MeasurementError, match=r"sensor 1 turned by 0\.\d degrees, 5 or more are needed; sensor 2"):
        axes_of_motion(rest, bias, 1)
    twisted = recording.rates.copy()
    twisted[:, 1] = twisted[:, 1] @ rotation(np.array([0, 0, 1.0]), 1.0)
    twisted[::2, 1] = recording.rates[::2, 1]
    with pytest.raises(MeasurementError, match=r"^no axes found: sensor 2 turned about more than one axis"):
        axes_of_motion(replace(recording, rates=twisted), bias, 1)
    other = np.roll(recording.rates, recording.times.size // 2, axis=0)
    alone = recording.rates.copy()
    alone[:, 0] = other[:, 0]
    with pytest.raises(MeasurementError, match="sensor 1 did not turn as the last one did"):
        axes_of_motion(replace(recording, rates=alone), bias, 1)
    with pytest.raises(InvalidValueError, match=r"1 \(towards cable 1\) or -1"):
        axes_of_motion(recording, bias, 2)


@given(SEEDS, st.floats(-3.1, 3.1))
def test_inclination_is_the_angle_by_which_the_link_turned(seed: int, angle: float) -> None:
    rng = np.random.default_rng(seed)
    axis, zero = any_rotation(rng)[:1], rng.normal(size=(1, 3))
    if np.linalg.norm(np.cross(axis, zero)) < 0.01:
        return
    seen = turned(zero, axis, np.array([-angle])) * rng.uniform(0.5, 2)
    expected = rotation(axis[0], -angle) @ zero[0]
    np.testing.assert_allclose(seen[0] / np.linalg.norm(seen), expected / np.linalg.norm(expected), atol=1e-12)
    np.testing.assert_allclose(inclination(seen, axis, zero), [angle], atol=1e-9)


def test_a_zero_from_a_known_posture_is_the_straight_one(recording: ImuRecording, rest: ImuRecording) -> None:
    known = steps(recording, rest)
    posture = np.array([10, -20, 30, 5, 15]) * DEG
    bent = replace(rest, forces=np.stack([turned(f, known.axis, -np.cumsum(posture)) for f in rest.forces]))
    np.testing.assert_allclose(known.with_zero(bent, posture).zero, known.zero, atol=1e-9)
    assert np.abs(known.with_zero(bent).zero - known.zero).max() > 1
    with pytest.raises(InvalidValueError, match="posture"):
        known.with_zero(bent, posture[:3])
    with pytest.raises(InvalidValueError, match="half a turn"):
        known.with_zero(bent, np.degrees(posture))


def test_steps_say_what_is_missing_and_what_each_was_found_from(recording: ImuRecording, rest: ImuRecording) -> None:
    nothing = CalibrationSteps()
    assert nothing.missing == ("bias", "zero", "axis")
    assert nothing.complete() is None
    with pytest.raises(MeasurementError, match="no axes without the bias"):
        nothing.with_axis(recording)
    with pytest.raises(MeasurementError, match="without the axes"):
        nothing.with_zero(rest, np.zeros(N))
    zeroed = nothing.with_zero(rest).with_bias(rest)
    assert zeroed.missing == ("axis",)
    whole = zeroed.with_axis(recording).complete()
    assert whole is not None
    again = CalibrationSteps.of(whole).with_bias(rest.part(1.0, 3.0)).complete()
    assert again is not None
    assert again.sources[0].count("bias of") == 1
    assert again.sources[0].startswith("zero of 5.3 s; axis of 25.0 s; bias of 2.0 s")
    np.testing.assert_array_equal(again.axis, whole.axis)


def test_rests_are_found(recording: ImuRecording) -> None:
    found = rests(recording)
    assert found[0][0] == recording.times[0]
    assert REST - 0.5 < found[0][1] < REST + 0.6
    assert found[-1][1] > recording.times[-1] - 0.5
    for (begin, end), after in zip(found, [*found[1:], (99.0, 99.0)], strict=True):
        assert unrest(recording.part(begin, end)) == ()
        assert end <= after[0]
        assert end < REST + 0.6 or begin > RELEASE


def test_a_file_gives_back_what_was_saved(tmp_path: Path, recording: ImuRecording, rest: ImuRecording) -> None:
    saved = steps(recording, rest).complete()
    assert saved is not None
    save_calibration(saved, tmp_path / "sensors.yaml")
    loaded = load_calibration(tmp_path / "sensors.yaml")
    assert loaded.sources == saved.sources
    for name in ("bias", "axis", "zero"):
        np.testing.assert_allclose(getattr(loaded, name), getattr(saved, name), rtol=1e-15)
    with pytest.raises(FileError, match="cannot be written"):
        save_calibration(saved, tmp_path / "no" / "folder.yaml")


ONE = "{bias: [0.0, 0.0, 0.0], axis: [0.0, 1.0, 0.0], zero: [0.0, 0.0, -9.8], source: by hand}"


@pytest.mark.parametrize(
    ("was", "becomes", "output"),
    [
        ("axis: [0.0, 1.0, 0.0]", "axis: [0.0, 1.0]", "axis"),
        ("axis: [0.0, 1.0, 0.0]", "axis: [0.0, 0.9, 0.0]", "axis of sensor 1 .* a unit vector"),
        ("axis: [0.0, 1.0, 0.0]", "axis: [0.0, 0.0, 1.0]", "away from gravity"),
        ("bias: [0.0, 0.0, 0.0]", "bias: [9.0, 0.0, 0.0]", "bias of sensor 1"),
        ("-9.8", "-98.0", "zero of sensor 1"),
        (", source: by hand", "", "sensor 1 must have bias, axis, zero, source"),
        ("source:", "sauce: x, source:", "and nothing else"),
        ("sensors", "sensor", "not a calibration of sensors"),
        (f"[{ONE}]", "[]", "not a calibration of sensors"),
        (ONE, "7", "sensor 1 must have"),
    ],
)
def test_a_damaged_file_is_refused_by_name(tmp_path: Path, was: str, becomes: str, output: str) -> None:
    path = tmp_path / "sensors.yaml"
    good = f"sensors: [{ONE}]\n"
    path.write_text(good)
    assert isinstance(load_calibration(path), Calibration)
    assert was in good
    path.write_text(good.replace(was, becomes))
    with pytest.raises((FileError, InvalidValueError), match=f"sensors.yaml: .*{output}"):
        load_calibration(path)
