"""The double pendulum's tables become recordings of a model that joint torques drive."""

from pathlib import Path

import numpy as np
import pytest

from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model_file import load_model
from continuum.recordings.recording_csv import read_recording_csv
from tools.benchmarks.exams.double_pendulum_csv import main

ROWS = 40
T = np.arange(ROWS) / 400
NAMES = (
    "t_s,q1_rad,q2_rad,dq1_rad_s,dq2_rad_s,tau_commanded_1_Nm,tau_commanded_2_Nm,tau_measured_1_Nm,tau_measured_2_Nm"
)
TABLE = np.column_stack([T, *(k * np.sin(20 * T + k) for k in range(1, 9))])
TABLE[:, 3:5] = np.gradient(TABLE[:, 1:3], T, axis=0)


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "run.csv"
    np.savetxt(path, TABLE, delimiter=",", header=NAMES, comments="")
    return path


@pytest.mark.parametrize(
    ("options", "columns"),
    [
        ((), (7, 8)),
        (("--torque", "commanded"), (5, 6)),
        (("--torque", "measured", "commanded"), (7, 6)),
        (("--torque", "commanded", "measured"), (5, 8)),
    ],
)
def test_a_table_becomes_a_recording(
    source: Path, tmp_path: Path, options: tuple[str, ...], columns: tuple[int, int]
) -> None:
    assert main([str(source), str(tmp_path / "out.csv"), *options]) == 0
    found = read_recording_csv(tmp_path / "out.csv")
    assert (found.notes, found.tensions) == ((), None)
    np.testing.assert_array_equal(found.theta, TABLE[:, 1:3])
    drive = found.inputs_for(load_model("double_pendulum.yaml"))
    assert isinstance(drive, JointTorques)
    np.testing.assert_array_equal(drive.values, TABLE[:, columns])


def test_another_table_is_refused_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "other.csv"
    path.write_text("t_s,q1_rad\n0,1\n", encoding="utf-8")
    assert main([str(path), str(tmp_path / "out.csv")]) == 2
    assert capsys.readouterr().err == f"{path}: has no column q2_rad; it has t_s, q1_rad\n"


def test_torques_of_more_joints_than_there_are_are_refused(
    source: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(source), str(tmp_path / "out.csv"), "--torque", *["measured"] * 3]) == 2
    assert "one for both joints or one for each" in capsys.readouterr().err
    assert not (tmp_path / "out.csv").exists()
