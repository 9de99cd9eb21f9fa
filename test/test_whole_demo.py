"""The demo's chain with real nodes on short trajectories, how it fails, and that it leaves nothing behind."""

import os
import re
import signal
from contextlib import suppress
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import yaml
from ament_index_python.packages import get_package_share_directory
from demo_process import DemoProcess
from domain_coordinator import domain_id
from geometry_msgs.msg import PoseStamped
from harness import Probe
from rosbags.rosbag2 import Reader
from sensor_msgs.msg import JointState

from continuum.arm import arm_to_mapping, load_arm
from continuum.parameter_file import flattened
from continuum.recordings.arm_recording import read_arm_recording
from continuum.recordings.bag import Bag
from continuum.recordings.kinematic_report import report_on
from continuum_manipulator.nodekit.qos import STREAM
from tools.demo import domain as demo_domain
from tools.demo.errors import DemoError
from tools.demo.folder import PREVIOUS, claimed
from trajectory_generator.from_parameters import trajectory_from_mapping

pytestmark = pytest.mark.ros

ARMS = Path(get_package_share_directory("continuum_description")) / "config"

COMMON = {"max_speed": 0.1, "max_acceleration": 0.1, "lead_time": 0.2, "rest_time": 0.2}

QUARTER_TURN = COMMON | {
    "path": "helix",
    "helix": {"radius": 0.15, "pitch": 0.08, "z_start": 0.25, "z_end": 0.27, "n_points": 21},
    "corner_radius": 0.14,
    "rate": 120.0,
}
"""A quarter turn of the thesis's helix."""

LONG_REST = QUARTER_TURN | {"rest_time": 600.0, "rate": 20.0}
"""The same, ending in a rest so long that whatever happens to the demo happens before its end."""


def trajectory_file(folder: Path, parameters: dict[str, object]) -> Path:
    path = folder / "trajectory.yaml"
    path.write_text(yaml.safe_dump({"/**": {"ros__parameters": parameters}}), encoding="utf-8")
    return path


def targets(parameters: dict[str, object]) -> np.ndarray:
    """Positions (n, 3) [m] of the poses that are to be published."""
    flat = flattened(parameters)
    trajectory = trajectory_from_mapping(flat)
    return trajectory.sample(trajectory.times(flat["rate"])).position


@pytest.fixture(scope="module")
def done(domain: int, tmp_path_factory: pytest.TempPathFactory) -> SimpleNamespace:
    """A demo that has run: what it said, the folder of its results, and the arm and poses that it was to follow."""
    folder = tmp_path_factory.mktemp("a demo")
    arm = ARMS / "three_sections.yaml"
    options = {"arm": arm, "trajectory": trajectory_file(folder, QUARTER_TURN)}
    with DemoProcess(folder / "out", domain, **options) as demo:
        code, out, err = demo.end()
        left = demo.processes()
    return SimpleNamespace(
        code=code, out=out, err=err, left=left, folder=folder / "out", arm=load_arm(arm), targets=targets(QUARTER_TURN)
    )


def test_the_demo_ends_well(done: SimpleNamespace) -> None:
    assert (done.code, done.err, done.left) == (0, "", [])
    assert re.search(r"^messages lost +0 *$", done.out, re.MULTILINE)
    assert f"{len(done.targets)}/{len(done.targets)} poses" in done.out
    assert {path.name for path in done.folder.iterdir()} == {"recording", "nodes.log", "cable_states.csv", "cables.png"}
    said = (done.folder / "nodes.log").read_text()
    assert "Traceback" not in said
    assert "process has died" not in said


def test_the_tip_follows_and_nothing_is_lost(done: SimpleNamespace) -> None:
    with Bag(done.folder / "recording") as bag:
        recording = read_arm_recording(bag, done.arm)
    np.testing.assert_allclose(recording.targets.values, done.targets, atol=1e-12)
    report = report_on(recording, len(done.targets))
    assert len(report.lost) == 5 + 2 * done.arm.n_sections
    assert sum(report.lost.values()) + sum(report.repeated.values()) == 0
    assert report.n_solved == len(done.targets)
    assert report.tip_error_median <= 0.5e-3
    assert report.tip_error_max <= 2e-3
    assert 0 < report.rate_disagreement_ratio <= 0.01
    assert report.largest_rate > 0.01


@pytest.fixture
def trajectory(tmp_path: Path) -> Path:
    return trajectory_file(tmp_path, QUARTER_TURN)


@pytest.fixture
def endless(tmp_path: Path) -> Path:
    return trajectory_file(tmp_path, LONG_REST)


def test_a_node_that_dies_at_start_is_reported(domain: int, tmp_path: Path, trajectory: Path) -> None:
    """The library takes the block of an arm alone; ROS wants it within a node's parameters."""
    arm = tmp_path / "arm.yaml"
    arm.write_text(yaml.safe_dump({"arm": arm_to_mapping(load_arm(ARMS / "prototype.yaml"))}))
    with DemoProcess(tmp_path / "out", domain, arm=arm, trajectory=trajectory) as demo:
        code, _, err = demo.end()
        assert demo.processes() == []
    assert code == 1
    assert re.fullmatch(
        r"demo: (section_1|robot|cable_tangler|markers)-\d died: .* \(exit code 2\); see .*nodes.log\n", err
    )


def test_a_node_that_is_killed_is_reported(domain: int, tmp_path: Path, endless: Path) -> None:
    with DemoProcess(tmp_path / "out", domain, trajectory=endless) as demo:
        demo.wait_for_node_line(" begins")
        (robot,) = demo.processes("lib/continuum_manipulator/robot")
        os.kill(robot, signal.SIGKILL)
        code, _, err = demo.end()
        assert demo.processes() == []
    assert code == 1
    assert re.fullmatch(r"demo: robot-4 died: .*\(exit code -9\); see .*nodes.log\n", err)


def test_an_interrupt_leaves_no_process_and_a_whole_recording(domain: int, tmp_path: Path, endless: Path) -> None:
    with DemoProcess(tmp_path / "out", domain, trajectory=endless) as demo:
        demo.wait_for_node_line(" begins")
        demo.send(signal.SIGINT)
        code, _, err = demo.end()
        assert demo.processes() == []
    assert code == 130
    assert err == f"demo: interrupted; what was recorded until then is in {tmp_path}/out/recording\n"
    with Reader(tmp_path / "out" / "recording") as reader:
        assert "/traj_pose" in reader.topics


def test_another_graph_in_the_domain_is_left_alone(tmp_path: Path, trajectory: Path) -> None:
    with domain_id() as number, Probe(number, "bench") as probe:
        received = probe.hear(PoseStamped, "traj_pose")
        probe.node.create_publisher(JointState, "joint_states", STREAM)
        with DemoProcess(tmp_path / "out", number, trajectory=trajectory) as demo:
            code, _, err = demo.end()
        probe.listen_until_quiet()
    assert code == 1
    assert err == f"demo: ROS domain {number} is in use by /bench; end them, or set ROS_DOMAIN_ID to another\n"
    assert received == []
    assert not (tmp_path / "out" / "nodes.log").exists()


def test_who_only_listens_is_welcome(domain: int) -> None:
    with Probe(domain, "watcher") as probe:
        probe.hear(JointState, "joint_states")
        assert demo_domain.speakers(domain) == []


def test_without_a_given_domain_a_free_one_is_taken(
    domain: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    seen: list[int] = []
    monkeypatch.setattr(demo_domain, "speakers", lambda number: seen.append(number) or ["/bench"] * (len(seen) < 3))
    with demo_domain.domain_for_demo() as chosen:
        assert seen == [0, seen[1], chosen]
        assert len({0, seen[1], chosen, domain}) == 4
    said = capsys.readouterr().out
    assert said.startswith("ROS domain 0 is in use by /bench; ")
    assert said.endswith(f"export ROS_DOMAIN_ID={chosen}\n")


def test_two_demos_share_no_domain(domain: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    monkeypatch.setattr(demo_domain, "speakers", lambda number: [])
    with demo_domain.domain_for_demo() as first:
        assert first == domain
        with pytest.raises(DemoError, match="in use by another demo"), demo_domain.domain_for_demo():
            pass
    with demo_domain.domain_for_demo() as again:
        assert again == domain


def names_in(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_two_demos_share_no_folder(tmp_path: Path) -> None:
    (tmp_path / "out" / "recording").mkdir(parents=True)
    for name in ("recording/metadata.yaml", "nodes.log", "mine.txt"):
        (tmp_path / "out" / name).touch()
    with claimed(tmp_path / "out"):
        assert names_in(tmp_path / "out") == {"mine.txt", PREVIOUS}
        (tmp_path / "out" / "nodes.log").touch()
        with pytest.raises(DemoError, match="another demo is writing"), claimed(tmp_path / "out"):
            pass
        assert (tmp_path / "out" / "nodes.log").exists()
    with claimed(tmp_path / "out"):
        pass


def test_what_the_demo_before_left_is_kept_until_there_is_more(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table, before = tmp_path / "cable_states.csv", tmp_path / PREVIOUS / "cable_states.csv"
    table.write_text("first")
    for _ in range(2):  # the second finds what the first of them left unfinished
        with suppress(KeyboardInterrupt), claimed(tmp_path):
            (tmp_path / "recording").mkdir()
            raise KeyboardInterrupt
        assert before.read_text() == "first"
        assert names_in(tmp_path) == {PREVIOUS, "recording"}
        assert capsys.readouterr().err == f"the results of the previous demo are in {tmp_path / PREVIOUS}\n"
    with claimed(tmp_path):
        table.write_text("second")
    assert (names_in(tmp_path), table.read_text()) == ({"cable_states.csv"}, "second")
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("options", "problem", "number"),
    [
        ({}, "ROS_DOMAIN_ID is '0x1'; allowed: a whole number from 0 to 232", "0x1"),
        ({"arm": Path("nowhere.yaml")}, "nowhere.yaml: cannot be read", None),
        ({"out": Path("/dev/null/out")}, "/dev/null/out cannot be made", None),
    ],
)
def test_what_cannot_begin_is_reported_in_one_line(
    tmp_path: Path, trajectory: Path, domain: int, options: dict[str, Path], problem: str, number: str | None
) -> None:
    with DemoProcess(tmp_path / "out", number or str(domain), **{"trajectory": trajectory} | options) as demo:
        code, _, err = demo.end()
    assert code == 1
    assert err.startswith(f"demo: {problem}")
    assert err.count("\n") == 1
