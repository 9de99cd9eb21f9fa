"""The launch file of arms: what is commanded arrives at every section, in both modes, and no node dies in silence."""

import os
import shlex
import signal
import subprocess
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from arm_launch import LAUNCH, launched, write, write_arm
from domain_coordinator import domain_id
from harness import Probe
from rosbags.highlevel import AnyReader
from sensor_msgs.msg import JointState

from continuum.arm import load_arm
from continuum.kinematics.routing import tangle
from continuum_manipulator.section_joints import read_joints, read_names
from continuum_msgs.msg import CableStates, ConfigStates

pytestmark = pytest.mark.ros

INSTANTS = 20
"""So many in a row must have come to every section."""


def stamp_of(message) -> tuple[int, int]:
    return message.header.stamp.sec, message.header.stamp.nanosec


@pytest.mark.parametrize("mode", ["inverse_kinematics", "cables"])
@pytest.mark.parametrize("n_sections", [1, 6])
def test_a_trajectory_arrives_at_every_section(n_sections, mode, tmp_path):
    arm_file = write_arm(tmp_path, n_sections)
    arm = load_arm(arm_file)
    line = {"start": [0.0, 0.01, 0.9 * arm.length], "end": [0.02, 0.0, 0.9 * arm.length]}
    motion = {"path": "line", "line": line, "rate": 30.0, "lead_time": 0.0, "rest_time": 0.0, "loop": True}
    trajectory = write(tmp_path / "a line.yaml", motion)
    recording = tmp_path / "recording"
    arguments = [f"arm:={arm_file}", f"mode:={mode}", f"trajectory:={trajectory}", f"record:={recording}"]
    with domain_id() as domain, Probe(domain) as probe:
        configurations = probe.hear(ConfigStates, "section_config_states")
        asked = probe.hear(JointState, "joint_states" if mode == "inverse_kinematics" else "joint_commands")
        cables = probe.hear(CableStates, "cable_states" if mode == "inverse_kinematics" else "cable_commands")
        joints = probe.hear(JointState, "joint_states")

        def everywhere() -> list[tuple[int, int]]:
            """Instants that every section and the whole arm's cables, and with those the joints, tell of."""
            seen = [{stamp_of(m) for m in configurations if m.section == i + 1} for i in range(n_sections)]
            seen.append({stamp_of(message) for message in cables})
            parts = n_sections if mode == "cables" else 1
            seen.append({stamp for stamp, count in Counter(map(stamp_of, joints)).items() if count == parts})
            return sorted(set.intersection(*seen))

        with launched(domain, tmp_path, *arguments) as launch:
            probe.wait_until(
                lambda: launch.process.poll() is not None or len(everywhere()) >= INSTANTS, lambda: launch.said
            )
            assert launch.process.poll() is None, launch.said
            launch.process.send_signal(signal.SIGINT)
            assert launch.exit_code() == 0, launch.said
        common = everywhere()
        between = {stamp_of(message) for message in asked if common[0] <= stamp_of(message) <= common[-1]}
        assert sorted(between) == common, "instants lost on the way"
        check_values(arm, asked, cables, joints, common)
    topics = {"/traj_pose", "/joint_states", "/section_cable_states", "/section_config_states"}
    topics |= {"/cable_states"} if mode == "inverse_kinematics" else {"/cable_commands", "/section_cable_commands"}
    with AnyReader([recording]) as reader:
        counts = {connection.topic: connection.msgcount for connection in reader.connections}
    assert {topic for topic in topics if counts.get(topic, 0) >= INSTANTS} == topics


def check_values(arm, asked, cables, joints, instants) -> None:
    """Cables are those of the joints asked for, and the arm's joints are those that these cables have."""

    def configurations(messages, stamp) -> dict[int, np.ndarray]:
        found = {}
        for message in (message for message in messages if stamp_of(message) == stamp):
            for i, section in enumerate(arm.sections):
                state = read_joints(read_names(message), message.position, (), section)
                found |= {} if state is None else {i: state.w}
        return found

    for stamp in (instants[0], instants[-1]):
        wanted = configurations(asked, stamp)
        w = np.array([wanted[i] for i in range(arm.n_sections)])
        (lengths,) = (message for message in cables if stamp_of(message) == stamp)
        assert tuple(lengths.name) == arm.cable_names
        np.testing.assert_allclose(lengths.position, tangle(w, arm), atol=1e-12)
        moved = configurations(joints, stamp)
        np.testing.assert_allclose([moved[i] for i in range(arm.n_sections)], w, atol=1e-6)


def test_rviz_shows_the_arm_of_the_file(tmp_path, monkeypatch):
    """Nothing is started; a stand-in for the package that no wheel has."""
    marker = tmp_path / "share" / "ament_index" / "resource_index" / "packages" / "rviz2"
    program = tmp_path / "lib" / "rviz2" / "rviz2"
    for path in (marker, program):
        path.parent.mkdir(parents=True)
        path.touch(0o755)
    monkeypatch.setenv("AMENT_PREFIX_PATH", os.pathsep.join([str(tmp_path), os.environ["AMENT_PREFIX_PATH"]]))
    done = subprocess.run(
        ["ros2", "launch", "--print", LAUNCH, f"arm:={write_arm(tmp_path, 4)}", "rviz:=true"],
        capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    names = [line.partition(":")[0] for line in done.stdout.splitlines()]
    sections = [f"section_{number}" for number in range(1, 5)]
    assert names == [*sections, "robot", "cable_tangler", "forward_kinematics", "markers", "rviz2"]
    (config,) = (word for word in shlex.split(done.stdout) if word.endswith(".rviz"))
    assert Path(config).is_file()


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_a_node_that_ends_ends_the_launch_and_is_named(number, domain, tmp_path):
    with launched(domain, tmp_path, f"arm:={write_arm(tmp_path, 2)}") as launch:
        launch.wait_for("[section_2]: part_1, 2 of 2")
        launch.kill_node("section_2", number)
        assert launch.exit_code() == 1
        code = {signal.SIGKILL: -9, signal.SIGINT: 0}[number]
        (line,) = (line for line in launch.said.splitlines() if line.startswith("[ERROR] [launch]"))
        assert f"section_2 ended with exit code {code}" in line


def test_a_recorder_that_cannot_begin_ends_the_launch(domain, tmp_path):
    """Who asked for a recording does not get a run without one."""
    folder = tmp_path / "recording"
    folder.mkdir()
    (folder / "mine.txt").touch()
    arguments = (f"arm:={write_arm(tmp_path, 1)}", f"record:={folder}", "trajectory:=helix.yaml")
    with launched(domain, tmp_path, *arguments) as launch:
        assert launch.exit_code() == 1
        assert f"{folder}: exists already and is not overwritten" in launch.said
        assert "[ERROR] [launch]: " in launch.said
        assert "started without" not in launch.said
    assert [path.name for path in folder.iterdir()] == ["mine.txt"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["arm:={folder}/none.yaml"], "{folder}/none.yaml"),
        (["arm:={folder}/bad.yaml"], "{folder}/bad.yaml: arm.sections"),
        (["arm:={folder}/worse.yaml"], "{folder}/worse.yaml"),
        (["mode:=tensions"], "inverse_kinematics, cables"),
        (["trajectory:={folder}/none.yaml"], "{folder}/none.yaml"),
        (["trajectory:=helixx.yaml"], "did you mean helix.yaml?"),
        (["trajektory:=helix.yaml"], "no argument 'trajektory'; did you mean trajectory?"),
    ],
)
def test_a_bad_argument_gives_one_line_and_nothing_runs(arguments, words, domain, tmp_path):
    write(tmp_path / "bad.yaml", {"arm": {"sections": []}})
    (tmp_path / "worse.yaml").write_text("{")
    with launched(domain, tmp_path, *(word.format(folder=tmp_path) for word in arguments)) as launch:
        assert launch.exit_code() == 1
        (line,) = launch.said.splitlines()
        assert words.format(folder=tmp_path) in line
