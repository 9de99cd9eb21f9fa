"""The exam compares methods that agree where nothing errs, on a clock and with a sign that it finds."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from inertial_arm import DEG
from turning_sensor import Turning, back_and_forth, sensed_turn

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.inertial.imu_recording import ImuRecording
from tools.benchmarks.exams.inertial_pair import OURS, RIVALS, PairResult, PairRun, delay, examined, read_run, section

EXACT = Turning(tilt=0.0, bias=0.0, force_bias=0.0, rate_noise=0.0, force_noise=0.0, lever=0.0)
ASKEW = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
UPSIDE_DOWN = np.diag([1.0, -1.0, -1.0])
RAW = "integrated difference of the raw rates"


def pair(sensor: Turning, duration: float = 40.0, mount: Array | None = None, late: float = 0.0) -> PairRun:
    """The second sensor turns, the first lies beside it at rest and askew; both are late by some seconds."""
    times, angle = back_and_forth(duration)
    seen = np.interp(times - late, times, angle)
    mount = np.eye(3) if mount is None else mount
    random = np.random.default_rng(1)
    resting, _ = sensed_turn(times, 0 * angle, replace(sensor, bias=0.0), random, ASKEW)
    moving, _ = sensed_turn(times, seen, sensor, random, mount)
    rates, forces, valid = (
        np.concatenate([getattr(resting, name), getattr(moving, name)], axis=1) for name in ("rates", "forces", "valid")
    )
    return PairRun(ImuRecording(times, rates, forces, ~valid, valid), angle)


def rms(result: PairResult) -> dict[str, float]:
    return {score.method: score.rms for score in result.scores}


@pytest.mark.parametrize("mount", [np.eye(3), UPSIDE_DOWN], ids=["upright", "upside down"])
@pytest.mark.parametrize("tilt", [0.0, 30.0])
def test_all_methods_follow_perfect_sensors(mount: Array, tilt: float) -> None:
    result = examined(pair(replace(EXACT, tilt=tilt * DEG), mount=mount))
    assert max(rms(result).values()) < 0.4  # of 180; filters that read a rate as a step are half a period early
    assert result.upright == pytest.approx(0.0, abs=tilt + 0.01)


def test_the_encoders_sign_is_found() -> None:
    run = pair(Turning())
    mirrored = replace(run, recording=replace(run.recording, rates=-run.recording.rates[:, :, :]), encoder=-run.encoder)
    assert rms(examined(mirrored))[RAW] == pytest.approx(rms(examined(run))[RAW], rel=1e-6)


@pytest.mark.parametrize("late", [-0.037, 0.0, 0.0123])
def test_a_known_delay_is_found_whatever_scale_bias_and_zero(late: float) -> None:
    times, angle = back_and_forth(40.0)
    seen = 1.02 * np.interp(times - late, times, angle) + 0.01 * times + 0.3
    assert delay(times, seen, angle) == pytest.approx(late, abs=1e-4)
    assert examined(pair(Turning(), late=late)).delay == pytest.approx(late, abs=2e-3)


def test_a_bias_adds_up_in_every_method_but_ours() -> None:
    result = examined(pair(Turning(tilt=1 * DEG, bias=0.2 * DEG), duration=120.0))
    drift = 0.2 * 120 / np.sqrt(3)
    errors = rms(result)
    assert errors.pop(OURS) < 0.1 * drift
    assert errors[RAW] == pytest.approx(drift, rel=0.1)
    assert set(errors) == set(RIVALS)
    assert min(errors.values()) > 0.5 * drift
    assert result.true_bias == pytest.approx(0.2, abs=0.01)
    assert abs(result.bias - 0.2) < 4 * result.bias_error


def test_about_a_horizontal_axis_ours_is_no_worse_than_vqf() -> None:
    errors = rms(examined(pair(Turning(tilt=90 * DEG, bias=0.2 * DEG), duration=120.0)))
    assert errors[OURS] <= min(errors.values()) + 0.1


def test_a_file_is_read_with_the_encoder_unwrapped_and_rows_of_the_same_time_left_out(tmp_path: Path) -> None:
    names = [f"{kind}{i}_{axis}" for kind in ("gyro", "accel") for i in (1, 2) for axis in "xyz"]
    t = np.repeat(np.arange(50) / 100, [2 if k == 7 else 1 for k in range(50)])
    turned = 3000 * t
    columns = [t, turned % 360, *(np.full_like(t, k) for k in range(12))]
    path = tmp_path / "run.csv"
    header = ",".join(["t_s", "encoder_deg", *names])
    np.savetxt(path, np.stack(columns, axis=1), delimiter=",", header=header, comments="")
    run = read_run(path)
    assert run.recording.times.size == 50
    np.testing.assert_allclose(np.degrees(run.encoder), 30 * np.arange(50), atol=1e-9)
    np.testing.assert_allclose(np.degrees(run.recording.rates[3]), [[0, 1, 2], [3, 4, 5]])
    np.testing.assert_allclose(run.recording.forces[3, 1], 9.81 * np.array([9, 10, 11]))
    path.write_text(path.read_text().replace("encoder_deg", "angle"))
    with pytest.raises(FileError, match="is no run of a pair of sensors"):
        read_run(path)


@pytest.mark.slow
def test_ours_is_best_on_the_recorded_run(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(repository)
    errors = rms(examined(read_run()))
    ours = errors.pop(OURS)
    assert ours < min(errors.values())
    text, (figure,) = section()
    assert all(f"| {method} |" in text for method in (OURS, *RIVALS))
    assert (figure.value, figure.rival_value) == (ours, min(errors.values()))


@pytest.fixture
def repository() -> Path:
    return Path(__file__).parents[4]
