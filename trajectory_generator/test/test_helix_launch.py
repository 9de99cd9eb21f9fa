"""The launch file of the helix: who asked for a recording does not get a run without one."""

import os
import signal
import subprocess
from pathlib import Path

import pytest
from harness.marked import Mark
from harness.waiting import LONG

pytestmark = pytest.mark.ros

LAUNCH = Path(__file__).resolve().parents[1] / "launch" / "helix.launch.xml"


def test_a_recorder_that_cannot_begin_ends_the_launch(domain, tmp_path):
    mark = Mark()
    (tmp_path / "mine.txt").touch()
    try:
        done = subprocess.run(
            ["ros2", "launch", str(LAUNCH), f"record:={tmp_path}", "markers:=false"],
            env=os.environ | mark.environment | {"ROS_DOMAIN_ID": str(domain)},
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=4 * LONG,
        )  # fmt: skip
        assert mark.processes() == []
    finally:
        for pid in mark.processes():
            os.kill(pid, signal.SIGKILL)
    assert f"{tmp_path}: exists already and is not overwritten" in done.stdout
    assert "started without" not in done.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]
