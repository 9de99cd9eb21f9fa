"""A launch as a process, by default that of arms, for tests."""

import os
import signal
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import yaml
from harness.marked import Mark
from harness.waiting import LONG, wait_until

from continuum.arm import Arm, Section, arm_to_mapping

LAUNCH = Path(__file__).resolve().parents[1] / "launch" / "arm.launch.py"
ARM = (str(LAUNCH), "markers:=false")


class Launch:
    """A launch, with what it says."""

    def __init__(self, domain: int, folder: Path, mark: Mark, arguments: tuple[str, ...]) -> None:
        self._said = tempfile.TemporaryFile()  # noqa: SIM115  (closed by close)
        self.mark = mark
        self.process = subprocess.Popen(
            ["ros2", "launch", *arguments],
            env=os.environ | mark.environment | {"ROS_DOMAIN_ID": str(domain), "ROS_LOG_DIR": str(folder / "log")},
            stdout=self._said,
            stderr=subprocess.STDOUT,
        )

    @property
    def said(self) -> str:
        return os.pread(self._said.fileno(), 1 << 24, 0).decode()

    def wait_for(self, text: str) -> None:
        wait_until(lambda: text in self.said, lambda: f"{text!r} in {self.said}")

    def kill_node(self, name: str, number: signal.Signals) -> None:
        (pid,) = self.mark.processes(f"__node:={name}")
        os.kill(pid, number)

    def exit_code(self) -> int:
        """Wait for the end, with which every process has ended."""
        code = self.process.wait(4 * LONG)
        assert self.mark.processes() == []
        return code

    def close(self) -> None:
        self.mark.kill()
        self.process.wait()
        self._said.close()


@contextmanager
def launched(domain: int, folder: Path, *arguments: str, file: tuple[str, ...] = ARM) -> Iterator[Launch]:
    """A launch of a file with these arguments, none of whose processes outlives the block."""
    launch = Launch(domain, folder, Mark(), (*file, *arguments))
    try:
        yield launch
    finally:
        launch.close()


def write_arm(folder: Path, n_sections: int) -> Path:
    """The file of an arm of so many sections of 2 joints, each twisted against the one before."""
    sections = [
        Section(f"part_{i}", n_joints=2, b=0.02, a=0.03, twist=0.2 * i, bend_limit=2.0) for i in range(n_sections)
    ]
    return write(folder / "an arm.yaml", {"arm": arm_to_mapping(Arm(tuple(sections)))})


def write(file: Path, parameters: dict[str, object]) -> Path:
    """A parameter file."""
    file.write_text(yaml.safe_dump({"/**": {"ros__parameters": parameters}}))
    return file
