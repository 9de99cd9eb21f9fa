"""`continuum import-dot`: from exported files to a run that `continuum diagnose` reads."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from command_line import Captured, code, refused
from inertial_arm import (
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
    write_exports,
)

from continuum.inertial.calibration_values import load_calibration, save_calibration
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.inclination import inclination
from continuum.recordings.recording_csv import read_recording_csv

pytestmark = pytest.mark.slow

HOW = ("--first-turn", "1", "--zero", "0:5")


@pytest.fixture(scope="module")
def motion() -> Motion:
    return pull_and_release()


@pytest.fixture(scope="module")
def recording(motion: Motion) -> ImuRecording:
    return sensed(motion, 120.0, SensorModel(), seed=4)[0]


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory, recording: ImuRecording) -> list[Path]:
    return write_exports(tmp_path_factory.mktemp("exports"), recording, 2**32 - 9_000_000)


def test_a_release_is_imported_for_diagnose(
    files: list[Path], motion: Motion, recording: ImuRecording, tmp_path: Path, capsys: Captured
) -> None:
    out = tmp_path / "new" / "run_1.csv"
    assert code("import-dot", *files, *HOW, "--begin", RELEASE, "--end", RELEASE + 3, "--out", out) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert f"written: {out}\n" in captured.out
    assert "\n36" in captured.out  # rows
    assert "120 readings a second" in captured.out
    run = read_recording_csv(out)
    assert run.times[0] == pytest.approx(RELEASE, abs=0.01)
    assert run.notes == ()
    times = run.times + recording.times[0]
    off = np.degrees(run.theta - motion.at(times)[0])
    assert rms(off).max() < 0.5
    assert rms(off[-60:]).max() < 0.3
    assert run.theta_rate is not None
    assert rms(np.degrees(run.theta_rate - motion.at(times - 0.5 / 120)[1])).max() < 5  # of up to 560 degrees/s


def test_a_calibration_serves_the_next_recording(
    files: list[Path], motion: Motion, recording: ImuRecording, tmp_path: Path, capsys: Captured
) -> None:
    sensors = tmp_path / "sensors.yaml"
    assert code("import-dot", *files, *HOW, "--save-calibration", sensors) == 0
    assert load_calibration(sensors).n_sensors == N
    # the next start has another bias, and no rest in a straight posture before it
    later = recording.part(RELEASE - 2.0, RELEASE + 5.0)
    later = replace(later, rates=later.rates + np.radians(0.2))
    out = tmp_path / "run.csv"
    assert code("import-dot", *write_exports(tmp_path, later), "--calibration", sensors, "--out", out) == 0
    assert f"written: {out}" in capsys.readouterr().out
    table = np.loadtxt(out, delimiter=",", skiprows=1)
    off = table[:, 1 : N + 1] - np.degrees(motion.at(table[:, 0] + later.times[0])[0])
    assert rms(off).max() < 0.5


def test_losses_clips_and_starts_one_after_the_other(
    motion: Motion, recording: ImuRecording, tmp_path: Path, capsys: Captured
) -> None:
    """Rows have good angles of all joints or are left out, and times are from the first sensor's start on."""
    part = recording.part(RELEASE - 2.0, RELEASE + 5.0)
    lost = np.random.default_rng(0).random((part.times.size, N)) < 0.003
    for sensor in range(N):
        lost[: 30 * (N - 1 - sensor), sensor] = True  # the last one starts first
    limit = np.radians(300)
    clipped = np.any(np.abs(part.rates) > limit, axis=2)
    assert clipped.any()
    troubled = replace(with_losses(part, lost), rates=np.clip(part.rates, -limit, limit), clipped=clipped)
    sensors, out = tmp_path / "sensors.yaml", tmp_path / "run.csv"
    save_calibration(calibrated(recording), sensors)
    exports = write_exports(tmp_path, troubled)
    assert code("import-dot", *exports, "--calibration", sensors, "--out", out) in (0, 1)
    assert "without valid angles" in capsys.readouterr().out
    table = np.loadtxt(out, delimiter=",", skiprows=1)
    assert len(table) > part.times.size / 2
    off = table[:, 1 : N + 1] - np.degrees(motion.at(table[:, 0] + part.times[0])[0])
    assert np.abs(off).max() < 1.0
    assert rms(off).max() < 0.5


def test_a_zero_in_a_known_posture(files: list[Path], recording: ImuRecording, tmp_path: Path) -> None:
    """Links are inclined by the sums of the joint angles, in degrees, where the arm has that posture."""
    posture, sensors = [10, -20, 30, 5, 15], tmp_path / "sensors.yaml"
    words = ("--first-turn", "1", "--zero", "0:5", "--posture", ",".join(map(str, posture)))
    assert code("import-dot", *files, *words, "--save-calibration", sensors) == 0
    known, seen = load_calibration(sensors), recording.part(recording.times[0], 5.0).forces.mean(axis=0)
    np.testing.assert_allclose(np.degrees(inclination(seen, known.axis, known.zero)), np.cumsum(posture), atol=0.1)


def test_a_dry_run_reports_when_the_arm_rests(files: list[Path], capsys: Captured) -> None:
    assert code("import-dot", *files) == 0
    out = capsys.readouterr().out
    assert "at rest    0.00 to 6." in out
    assert "nothing written; --out names a file" in out


def test_what_diagnose_would_refuse_is_said(files: list[Path], tmp_path: Path, capsys: Captured) -> None:
    out = tmp_path / "run.csv"
    assert code("import-dot", *files, *HOW, "--end", REST - 1, "--out", out) == 1
    assert "diagnose would refuse it" in capsys.readouterr().err
    assert out.is_file()


@pytest.mark.parametrize(
    ("words", "output"),
    [
        (("--first-turn", "1"), "the zero of the sensors is not known: give --zero"),
        (("--first-turn", "1", "--posture", "0,0,0,0,0"), "--posture is '0,0,0,0,0'; allowed: only with --zero"),
        (("--zero", "0:5"), "the axis of the sensors is not known: give --first-turn"),
        (("--first-turn", "1", "--zero", "5"), "--zero is '5'; allowed: two times"),
        (("--first-turn", "1", "--zero", "5:1"), "--zero is '5:1'"),
        (("--first-turn", "1", "--zero", "8:12"), "the zero can be set only at rest: sensor 1"),
        ((*HOW, "--posture", "1,x"), "--posture is '1,x'"),
        ((*HOW, "--posture", "1,2"), "posture"),
        ((*HOW, "--begin", "99"), "no instant between --begin and --end"),
        ((*HOW, "--calibration", "no.yaml"), "no.yaml: cannot be read"),
    ],
)
def test_what_cannot_be_done_is_refused(
    files: list[Path], tmp_path: Path, capsys: Captured, words: tuple[str, ...], output: str
) -> None:
    written = ("--out", tmp_path / "new" / "run.csv", "--save-calibration", tmp_path / "new" / "sensors.yaml")
    assert code("import-dot", *files, *words, *written) == 2
    assert output in capsys.readouterr().err.splitlines()[-1]
    assert not any(tmp_path.iterdir())


def test_sensors_that_were_not_synchronised_are_refused(
    recording: ImuRecording, tmp_path: Path, capsys: Captured
) -> None:
    files = write_exports(tmp_path, recording)
    late = write_exports(tmp_path / "late", recording, 1_500_000)
    assert "move at different times" in refused(capsys, "import-dot", *files[:4], late[4])


def test_files_that_do_not_fit_are_refused(files: list[Path], tmp_path: Path, capsys: Captured) -> None:
    assert "as in CSV exports of an Xsens DOT" in refused(capsys, "import-dot", __file__)
    assert "cannot be read" in refused(capsys, "import-dot", tmp_path / "no.csv")
    assert "cannot be written" in refused(capsys, "import-dot", *files, "--out", __file__ + "/run.csv")
    assert "is read, and would be overwritten" in refused(capsys, "import-dot", *files, "--out", files[2])
    sensors = tmp_path / "sensors.yaml"
    assert code("import-dot", *files[:3], *HOW, "--save-calibration", sensors) == 0
    assert code("import-dot", *files, "--calibration", sensors, "--out", tmp_path / "run.csv") == 2
    assert "3 sensors, not 5" in capsys.readouterr().err
