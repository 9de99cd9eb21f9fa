"""Recordings of arms that joint torques drive: tables, bags, and what a model takes of them."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from dynamics_laws import random_model
from recorded_runs import Topics
from recorded_runs import write as write_bag
from swing_bag import JOINTS as BAG_JOINTS
from swing_bag import swing
from test_chain_motion import chain, start, torques
from test_recording_csv import T, cells, sway, without, write

from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import InputKind
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.errors import FileError, InvalidValueError
from continuum.recordings.motion_table import write_motion_table
from continuum.recordings.recording import Recording
from continuum.recordings.recording_bag import read_recording_bag
from continuum.recordings.recording_csv import read_recording_csv

TORQUE = np.stack([0.3 * np.sin(5 * T), -0.2 * np.cos(5 * T)], axis=1)
OF_TORQUES = {f"tau{j + 1}_Nm": TORQUE[:, j] for j in range(2)}
FREE = without(sway(), "u1_N", "u2_N")


def driven() -> dict[str, list[str]]:
    return FREE | without(cells(**OF_TORQUES), "t_s")


def test_torques_of_a_table_are_read(tmp_path: Path) -> None:
    found = read_recording_csv(write(tmp_path, driven()))
    assert (found.notes, found.tensions, found.is_driven) == ((), None, True)
    assert found.torques is not None
    np.testing.assert_array_equal(found.torques.values, TORQUE)
    np.testing.assert_array_equal(found.torques.times, T)
    assert found.rows(slice(0, 50)).torques is found.torques


def test_a_simulated_motion_is_read_as_written(tmp_path: Path) -> None:
    drive = torques(2)
    motion = Simulator(chain(2)).run(start(2), T, drive)
    write_motion_table(motion, drive, tmp_path / "motion.csv")
    found = read_recording_csv(tmp_path / "motion.csv")
    np.testing.assert_allclose(found.theta, motion.theta, rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(found.inputs_for(chain(2)).values, drive.over(T), rtol=1e-8)


@pytest.mark.parametrize(
    ("change", "output"),
    [
        (lambda table: table | sway(), "has tensions, u1_N .., and torques, tau1_Nm ..: one or the other"),
        (lambda table: without(table, "tau2_Nm"), "has 2 joint angles but 1 joint torques"),
        (lambda table: without(table, "tau1_Nm"), "has tau of 2: numbers must run from 1"),
        (lambda table: table | {"tau2_lbf": table["tau2_Nm"]}, "has the column tau2_lbf; allowed units of tau: Nm"),
        (lambda table: table | {"tau2_Nm": ["2500"] * T.size}, r"row 2, tau2: a torque of 2.5e\+03 N m; no drive"),
    ],
)
def test_torques_that_cannot_be_are_refused(
    tmp_path: Path, change: Callable[[dict[str, list[str]]], dict[str, list[str]]], output: str
) -> None:
    with pytest.raises(FileError, match=output):
        read_recording_csv(write(tmp_path, change(driven())))


def test_joints_with_drives_may_turn_further_than_joints_between_discs(tmp_path: Path) -> None:
    turning = {f"q{j + 1}_rad": [repr(7.0 * float(t)) for t in T] for j in range(2)}
    slow = {f"dq{j + 1}_rad_s": ["7.0"] * T.size for j in range(2)}
    assert np.max(read_recording_csv(write(tmp_path, driven() | turning | slow)).theta) > 2 * np.pi
    with pytest.raises(FileError, match=r"no joint turns by more than 3\.14"):
        read_recording_csv(write(tmp_path, FREE | turning | slow))


def recording() -> Recording:
    return Recording("run", T, np.stack([0.3 * np.cos(T), 0.2 * np.sin(T)], axis=1))


def test_a_model_takes_the_inputs_that_suit_it() -> None:
    free, cables, chain_2 = recording(), random_model(71, 2), chain(2)
    pulled = replace(free, tensions=Tensions(T, np.abs(TORQUE)))
    turned = replace(free, torques=JointTorques(T, TORQUE))
    assert pulled.inputs_for(cables) is pulled.tensions
    assert turned.inputs_for(chain_2) is turned.torques
    assert free.inputs_for(cables).kind is InputKind.CABLES
    np.testing.assert_array_equal(free.inputs_for(chain_2).values, [[0.0, 0.0]])
    with pytest.raises(InvalidValueError, match=r"^run: kind of inputs is 'tensions of cables'; allowed: joint tor"):
        pulled.inputs_for(chain_2)
    with pytest.raises(InvalidValueError, match=r"^run: kind of inputs is 'joint torques'; allowed: tensions"):
        turned.inputs_for(cables)
    with pytest.raises(InvalidValueError, match=r"^run: number of joints is 2; allowed: 3, as the model"):
        free.inputs_for(chain(3))


def test_a_recording_has_tensions_or_torques_of_every_joint() -> None:
    with pytest.raises(InvalidValueError, match="allowed: one or the other"):
        replace(recording(), tensions=Tensions(T, np.abs(TORQUE)), torques=JointTorques(T, TORQUE))
    with pytest.raises(InvalidValueError, match="number of torques is 1; allowed: 2, one for each joint"):
        replace(recording(), torques=JointTorques(T, TORQUE[:, :1]))


def bag_with_efforts(*, cables: bool = False, effort: float | None = None) -> tuple[Topics, np.ndarray]:
    """Messages, and the efforts of the bending joints."""
    topics = swing()
    if not cables:
        del topics["/cable_states"]
    efforts = np.random.default_rng(0).normal(size=(len(topics["/joint_states"]), BAG_JOINTS))
    for one, row in zip(topics["/joint_states"], efforts, strict=True):
        values = np.concatenate([[0.0], row, [0.0]])
        one.effort = values if effort is None else np.full(values.size, effort)
    return topics, efforts


def test_efforts_of_the_joints_are_torques(tmp_path: Path) -> None:
    topics, efforts = bag_with_efforts()
    for one in topics["/joint_states"]:
        one.name, one.position, one.velocity, one.effort = (
            one.name[::-1], one.position[::-1].copy(), one.velocity[::-1].copy(), one.effort[::-1].copy()
        )  # fmt: skip
    found = read_recording_bag(write_bag(tmp_path / "run", topics))
    assert (found.notes, found.tensions) == ((), None)
    assert found.torques is not None
    np.testing.assert_array_equal(found.torques.values, efforts)


@pytest.mark.parametrize(("effort", "cables"), [(np.nan, False), (np.inf, True), (0.0, True)])
def test_efforts_that_say_nothing_are_none(tmp_path: Path, effort: float, cables: bool) -> None:
    topics, _ = bag_with_efforts(cables=cables, effort=effort)
    found = read_recording_bag(write_bag(tmp_path / "run", topics))
    assert (found.torques, found.is_driven) == (None, cables)


def test_a_message_without_efforts_is_left_out(tmp_path: Path) -> None:
    topics, efforts = bag_with_efforts()
    topics["/joint_states"][4].effort = np.zeros(0)
    found = read_recording_bag(write_bag(tmp_path / "run", topics))
    assert found.notes == ("message 5 without a finite value in every column, left out",)
    assert found.torques is not None
    np.testing.assert_array_equal(found.torques.values, np.delete(efforts, 4, axis=0))


def test_efforts_of_joints_and_of_cables_are_refused(tmp_path: Path) -> None:
    topics, _ = bag_with_efforts(cables=True)
    with pytest.raises(FileError, match="has efforts on /joint_states and on /cable_states"):
        read_recording_bag(write_bag(tmp_path / "run", topics))
