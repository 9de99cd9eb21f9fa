"""A block's commands at work together, in one ROS domain, and all of them ended with it."""

import os
import re
import signal
import subprocess
import tempfile
from pathlib import Path
from types import TracebackType
from urllib.request import urlopen

from diagnostic_msgs.msg import DiagnosticArray
from harness import Probe
from harness.marked import Mark
from harness.waiting import LONG, wait_until
from sensor_msgs.msg import JointState

from continuum_msgs.msg import CableStates
from readme.blocks import without_comment
from readme.ways import Run

TOPICS = {"/cable_states": CableStates, "/joint_states": JointState, "/diagnostics": DiagnosticArray}
"""Topics that are listened to while the commands run."""

ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+")
"""Of a page that is served on this host alone."""

ENDS_BY_CTRL_C = (0, signal.SIGINT, 128 + signal.SIGINT, -signal.SIGINT)
"""Exit codes of what ends in good order by Ctrl-C: of nodes, of `ros2`, of shells, and of what does not take it."""

PATIENCE = 5 * LONG
"""For a diagnosis on a machine that is busy [s]."""


class Command:
    """One command in a shell of its own that has sourced the workspace; it has its own process group, as a job has."""

    def __init__(self, text: str, way: Run, folder: Path, environment: dict[str, str]) -> None:
        self.text, self.way = text, way
        if way.also:
            text = f"{without_comment(text)} {way.also.format(folder=folder)}"
        self._written = tempfile.TemporaryFile()  # noqa: SIM115  (closed by close)
        self.process = subprocess.Popen(
            ["bash", "-c", f"source install/setup.bash || exit\n{text}\n"],
            cwd=folder,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=self._written,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )

    @property
    def said(self) -> str:
        """What it has written up to now."""
        return os.pread(self._written.fileno(), 1 << 24, 0).decode(errors="replace")

    def __str__(self) -> str:
        """The command and the end of what it said, for whoever reads of a failure."""
        return f"{self.text}\n{self.said[-2000:]}"

    def says_all(self) -> bool:
        return all(re.search(pattern, self.said) for pattern in self.way.says)

    def interrupt(self) -> None:
        """Ctrl-C, and its end."""
        assert self.process.poll() is None, f"ended by itself: {self}"
        os.killpg(self.process.pid, signal.SIGINT)
        code = self.process.wait(PATIENCE)
        assert code in ENDS_BY_CTRL_C, f"exit code {code}: {self}"

    def end(self) -> None:
        """Wait for it, and check its exit code and what it said."""
        code = self.process.wait(PATIENCE)
        assert code in self.way.codes, f"exit code {code}: {self}"
        assert self.says_all(), f"not said: {self.way.says}: {self}"

    def close(self) -> None:
        self.process.wait(LONG)
        self._written.close()


class Scene:
    """Commands that run one after another or at the same time. Use as a context.

    Args:
        folder: where they run, like a checkout that is set up.
        domain: ROS domain.
    """

    def __init__(self, folder: Path, domain: int) -> None:
        self._folder = folder
        self._mark = Mark()
        self._environment = os.environ | self._mark.environment | {"ROS_DOMAIN_ID": str(domain)}
        self._probe = Probe(domain)
        self._received = {topic: self._probe.hear(kind, topic) for topic, kind in TOPICS.items()}
        self._commands: list[Command] = []
        self._staying: list[Command] = []

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        self._mark.kill()
        for command in self._commands:
            command.close()
        self._probe.__exit__(kind, error, trace)

    def run(self, text: str, way: Run) -> None:
        """Run a command to its end, or if it stays, until all that shows its work is there."""
        if way.after_ctrl_c:
            self.interrupt()
        for received in self._received.values():
            received.clear()
        command = Command(text, way, self._folder, self._environment)
        self._commands.append(command)
        if way.stays:
            self._staying.append(command)
        else:
            command.end()
        self._wait(command, command.says_all, "its words")
        for topic, count in way.hears:
            received = self._received[topic]
            self._wait(
                command, lambda received=received, count=count: len(received) >= count, f"{count} messages on {topic}"
            )
        names = self._probe.node.get_node_names
        self._wait(command, lambda: set(way.nodes) <= set(names()), f"nodes {way.nodes}")
        if way.serves:
            self._wait(command, lambda: ADDRESS.search(command.said), "the address of its page")
            with urlopen(ADDRESS.search(command.said)[0], timeout=PATIENCE) as answer:
                assert b"<html" in answer.read().lower()
        if way.listens:
            own = int(way.listens in TOPICS)
            count = self._probe.node.count_subscribers
            self._wait(command, lambda: count(way.listens) > own, f"a listener on {way.listens}")

    def interrupt(self) -> None:
        """Ctrl-C to all that stays, the latest first; nothing of it may be left."""
        while self._staying:
            self._staying.pop().interrupt()
        wait_until(lambda: not self._mark.processes(), "end of all that a command started", PATIENCE)

    def end(self) -> None:
        """The same at the end, when all files must be there."""
        self.interrupt()
        for command in self._commands:
            gone = [pattern for pattern in command.way.leaves if not any(self._folder.glob(pattern))]
            assert gone == [], f"{command.text} left no {gone}: {command}"

    def _wait(self, command: Command, condition, what: str) -> None:
        def met() -> bool:
            assert not command.way.stays or command.process.poll() is None, f"ended: {command}"
            return condition()

        self._probe.wait_until(met, lambda: f"{what} of {command}", PATIENCE)
