"""A node of the workspace as a process of its own, started as ``ros2 run`` starts it."""

import os
import signal
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from ament_index_python.packages import get_package_prefix, get_package_share_directory

from harness.waiting import LONG, wait_until

ARM_FILE = Path(get_package_share_directory("continuum_description")) / "config" / "three_sections.yaml"


class NodeProcess:
    """A running node.

    Args:
        package, executable: which program.
        domain: ROS domain.
        name: of the node, if not its own.
        files: parameter files.
        parameters: by name; values as they would be typed.
        arguments: further ones.
    """

    def __init__(
        self,
        package: str,
        executable: str,
        domain: int,
        *,
        name: str | None = None,
        files: tuple[Path, ...] = (),
        parameters: Mapping[str, object] | None = None,
        arguments: tuple[str, ...] = (),
    ) -> None:
        command = [str(Path(get_package_prefix(package)) / "lib" / package / executable), *arguments, "--ros-args"]
        for file in files:
            command += ["--params-file", str(file)]
        for key, value in (parameters or {}).items():
            command += ["-p", f"{key}:={value}"]
        if name:
            command += ["-r", f"__node:={name}"]
        environment = os.environ | {"ROS_DOMAIN_ID": str(domain)}
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115  (closed by close)
        self.process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=self._errors, env=environment)

    @property
    def stderr(self) -> str:
        """What it has written to stderr."""
        return os.pread(self._errors.fileno(), 1 << 24, 0).decode()

    @property
    def running(self) -> bool:
        return self.process.poll() is None

    def wait_for_line(self, text: str) -> None:
        """Wait until ``text`` stands in its stderr."""
        wait_until(lambda: text in self.stderr, lambda: f"{text!r} in stderr, which is {self.stderr!r}")

    def wait_for_handler(self) -> None:
        """Wait until the process takes SIGTERM itself: the first that a node does."""
        bit = 1 << (signal.SIGTERM - 1)
        status = Path(f"/proc/{self.process.pid}/status")
        wait_until(
            lambda: int(status.read_text().split("SigCgt:")[1].split()[0], 16) & bit, "handler of SIGTERM", pause=0
        )

    def send(self, number: signal.Signals) -> None:
        self.process.send_signal(number)

    def exit_code(self, timeout: float = LONG) -> int:
        """Wait for the end."""
        return self.process.wait(timeout)

    def stop(self, number: signal.Signals = signal.SIGINT) -> int:
        """Send a signal and wait for the end."""
        self.send(number)
        return self.exit_code()

    def close(self) -> None:
        """End it in any case; a second call does nothing."""
        if self.running:
            self.process.kill()
            self.process.wait()
        self._errors.close()


@contextmanager
def ended_in_any_case(*nodes: NodeProcess) -> Iterator[tuple[NodeProcess, ...]]:
    """Nodes that are killed at the end of the block if they still run."""
    try:
        yield nodes
    finally:
        for node in nodes:
            node.close()


@contextmanager
def running(*nodes: NodeProcess) -> Iterator[tuple[NodeProcess, ...]]:
    """Nodes that must live until the end of the block, and are then interrupted.

    Of a killed one, others would believe for 20 s that it still runs.
    """
    with ended_in_any_case(*nodes):
        yield nodes
        for node in nodes:
            assert node.running, f"{node.process.args} ended with {node.process.returncode}: {node.stderr}"
            node.send(signal.SIGINT)
        for node in nodes:
            node.exit_code()
