"""Angles logged within one turn are made continuous where joints turn round, and refused where they cannot."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from csv_runs import text_of
from hypothesis import given
from hypothesis import strategies as st
from recorded_runs import write as write_bag
from swing_bag import swing

from continuum.dynamics.model_file import load_model
from continuum.errors import FileError
from continuum.recordings.read_recording import read_recording
from continuum.recordings.recording_checks import repaired
from continuum.recordings.samples import Samples

ROWS = 300
WRAPS = {180: -np.pi, 360: 0.0}
"""Least angle of a log that wraps at an angle [degrees]."""


def logged(theta: np.ndarray, wraps: int) -> np.ndarray:
    """Angles as a log within one turn has them."""
    return (theta - WRAPS[wraps]) % (2 * np.pi) + WRAPS[wraps]


def turning(rate: float, start: float, swing_by: float, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, angles and rates of two joints that turn round and swing; at least a turn in all."""
    t = np.arange(ROWS) / rate
    noise = 5e-4 * np.random.default_rng(seed).standard_normal((ROWS, 2))
    phase = 2 * np.pi * t / t[-1]
    first = start + 1.2 * phase + swing_by * np.sin(3 * phase)
    theta = np.stack([first, np.pi + 0.4 * np.sin(2 * phase)], axis=1)
    return t, theta + noise, np.gradient(theta, t, axis=0)


@given(
    rate=st.floats(60.0, 1000.0), start=st.floats(-3.0, 3.0), swing_by=st.floats(0.2, 1.5),
    wraps=st.sampled_from(sorted(WRAPS)), with_rates=st.booleans(), seed=st.integers(0, 99),
)  # fmt: skip
def test_turning_joints_are_continuous_and_begin_within_half_a_turn(
    rate: float, start: float, swing_by: float, wraps: int, with_rates: bool, seed: int
) -> None:
    t, theta, rates = turning(rate, start, swing_by, seed)
    theta[:, 1] += WRAPS[wraps] + np.pi - np.pi * (wraps == 360)  # about the end of the log
    table = Samples(
        Path("run.csv"), np.arange(2, ROWS + 2), t, logged(theta, wraps), rates if with_rates else None, None,
        torque=np.ones((ROWS, 2)), turns=True,
    )  # fmt: skip
    found, notes = repaired(table)
    away = found.theta - theta
    np.testing.assert_allclose(away, np.broadcast_to(away[0], away.shape), atol=1e-9)
    np.testing.assert_allclose(np.cos(away), 1.0, atol=1e-9)
    assert np.all(np.abs(found.theta[0]) <= np.pi + 1e-9)
    for joint in range(2):
        rows = 1 + np.flatnonzero(np.abs(np.diff(table.theta[:, joint])) > 4)
        about = [note for note in notes if f"q{joint + 1} jumps" in note]
        assert len(about) == bool(rows.size)
        assert all(f" {table.numbers[rows[0]]}" in note for note in about)


@pytest.mark.parametrize("wraps", sorted(WRAPS))
@pytest.mark.parametrize("zero", [0.0, 1.0, -2.5])
def test_recordings_of_one_arm_have_the_same_angles_for_the_same_pose(wraps: int, zero: float) -> None:
    """Whether their log crosses its end or not; and a note says what was shifted."""
    t = np.arange(ROWS) / 200
    for away in (0.4, 0.05):
        true = np.stack([away * np.sin(5 * t) - 0.2, 0.3 * np.cos(5 * t)], axis=1)
        shown = logged(true - zero, wraps) + zero
        found, notes = repaired(
            Samples(
                Path("run.csv"), np.arange(2, ROWS + 2), t, shown, None, None, torque=np.ones((ROWS, 2)), turns=True
            )
        )
        np.testing.assert_allclose(found.theta, true, atol=1e-9)
        for joint in np.flatnonzero(np.abs(shown[0] - true[0]) > 1):
            assert any(f"q{joint + 1} begins at {np.degrees(shown[0, joint]):.1f}" in note for note in notes)


def test_a_single_row_off_by_a_turn_is_left_out() -> None:
    t = np.arange(ROWS) / 200
    theta = 0.4 * np.stack([np.sin(5 * t), np.cos(5 * t)], axis=1)
    table = Samples(Path("run.csv"), np.arange(2, ROWS + 2), t, theta.copy(), None, None)
    table.theta[100, 1] += 2 * np.pi
    found, notes = repaired(table)
    np.testing.assert_array_equal(found.theta, np.delete(theta, 100, axis=0))
    assert [note for note in notes if "102" in note]


@given(st.floats(60.0, 1000.0), st.floats(-3.0, 3.0), st.sampled_from(sorted(WRAPS)))
def test_joints_that_cannot_turn_round_are_refused_with_row_angles_and_time(
    rate: float, start: float, wraps: int
) -> None:
    t, theta, _ = turning(rate, start, 0.0, 0)
    shown = logged(theta[:, :1], wraps)
    row = 1 + int(np.argmax(np.abs(np.diff(shown[:, 0])) > 4))
    first, then = np.degrees(shown[row - 1 : row + 1, 0])
    with pytest.raises(FileError) as refused:
        repaired(Samples(Path("run.csv"), np.arange(2, ROWS + 2), t, shown, None, None))
    assert f"row {row + 2}, q1: " in str(refused.value)
    assert f"{first:.4g} to {then:.4g} degrees" in str(refused.value)
    assert f"at {wraps} degrees?" in str(refused.value)


@pytest.mark.parametrize("size", [3.5, 5.0, 5.9, -4.4])
def test_a_step_that_is_no_whole_turn_is_a_fault_of_the_sensor(size: float) -> None:
    t, theta, _ = turning(200.0, -1.0, 0.0, 0)
    shown = logged(theta, 180)
    shown[150, 1] = shown[149, 1] - np.sign(shown[149, 1]) * abs(size)
    table = Samples(
        Path("run.csv"), np.arange(2, ROWS + 2), t, shown, None, None, torque=np.ones((ROWS, 2)), turns=True
    )
    with pytest.raises(FileError, match="row 152, q2: from "):
        repaired(table)


@pytest.mark.parametrize("unit", ["deg", "rad"])
@pytest.mark.parametrize("driven", [True, False])
def test_a_table_is_unwrapped_in_its_unit(tmp_path: Path, unit: str, driven: bool) -> None:
    """Without torques, the model says that its joints turn round."""
    t, theta, rates = turning(200.0, 0.5, 0.3, 1)
    factor = {"deg": 180 / np.pi, "rad": 1.0}[unit]
    columns = {"t_s": t}
    columns |= {f"q{j + 1}_{unit}": factor * logged(theta, 180)[:, j] for j in range(2)}
    columns |= {f"dq{j + 1}_{unit}_s": factor * rates[:, j] for j in range(2)}
    columns |= {f"tau{j + 1}_Nm": np.sin(t) for j in range(2)} if driven else {}
    file = tmp_path / "run.csv"
    file.write_text(text_of({name: [repr(float(one)) for one in column] for name, column in columns.items()}))
    found = read_recording(file, None if driven else load_model("double_pendulum.yaml"))
    np.testing.assert_allclose(found.theta - found.theta[0], theta - theta[0], atol=1e-9)
    assert [note for note in found.notes if "unwrapped" in note]


def test_messages_are_unwrapped(tmp_path: Path) -> None:
    topics = swing()
    del topics["/cable_states"]
    true = []
    for number, one in enumerate(topics["/joint_states"]):
        true.append([0.2, 3.0 + 0.02 * number, -0.1 * np.sin(0.1 * number)])
        one.position = np.concatenate([[0.0], logged(np.array(true[-1]), 180), [0.0]])
        one.velocity, one.effort = np.zeros(0), np.concatenate([[0.0], np.ones(3), [0.0]])
    found = read_recording(write_bag(tmp_path / "run", topics))
    np.testing.assert_allclose(found.theta, true, atol=1e-9)
    assert [note for note in found.notes if "message" in note and "q2" in note]


def test_angles_without_jumps_are_as_they_were() -> None:
    t, theta, _ = turning(200.0, 2.0, 0.5, 2)
    table = Samples(
        Path("run.csv"), np.arange(2, ROWS + 2), t, theta, None, None, torque=np.ones((ROWS, 2)), turns=True
    )
    found, notes = repaired(table)
    np.testing.assert_array_equal(found.theta, theta)
    assert notes == ()
    assert repaired(replace(table, theta=theta / 5, turns=False))[1] == ()
