"""The command as a process of its own, in a ROS domain of its own, ended in any case."""

import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from harness.waiting import LONG, wait_until

TOOLS = Path(__file__).parents[1]


class Running:
    """A command that has been started; what it says on either stream can be read while it runs."""

    def __init__(self, words: tuple[object, ...], environment: dict[str, str], folder: Path) -> None:
        self._out, self._err = (tempfile.TemporaryFile() for _ in range(2))  # noqa: SIM115  (closed by close)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "ros2_standin", *map(str, words)],
            env=environment,
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=self._out,
            stderr=self._err,
        )

    @property
    def stdout(self) -> str:
        return os.pread(self._out.fileno(), 1 << 24, 0).decode()

    @property
    def stderr(self) -> str:
        return os.pread(self._err.fileno(), 1 << 24, 0).decode()

    def wait_for(self, text: str, count: int = 1) -> None:
        """Wait until ``text`` stands ``count`` times in its output."""

        def there() -> bool:
            return self.stdout.count(text) >= count

        wait_until(lambda: there() or self.process.poll() is not None, self._state)
        assert there(), self._state()

    def _state(self) -> str:
        return f"exit code {self.process.poll()}, stdout {self.stdout!r}, stderr {self.stderr!r}"

    def stop(self, number: signal.Signals = signal.SIGINT) -> int:
        """Send a signal and wait for the end."""
        self.process.send_signal(number)
        return self.exit_code()

    def exit_code(self) -> int:
        return self.process.wait(LONG)

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        self._out.close()
        self._err.close()


class Ros2:
    """Starts commands.

    Args:
        domain: their ROS domain.
        folder: their working folder, and that of their logs.
    """

    def __init__(self, domain: int, folder: Path) -> None:
        self.folder = folder
        self.environment = os.environ | {
            "ROS_DOMAIN_ID": str(domain),
            "ROS_LOG_DIR": str(folder / "log"),
            "TMPDIR": str(folder),
            "PYTHONPATH": os.pathsep.join([str(TOOLS), os.environ.get("PYTHONPATH", "")]),
        }
        self._started: list[Running] = []

    def start(self, *words: object) -> Running:
        """A command that goes on beside the test."""
        self._started.append(Running(words, self.environment, self.folder))
        return self._started[-1]

    def __call__(self, *words: object, code: int = 0) -> Running:
        """A command from start to end, with the exit code it should have."""
        running = self.start(*words)
        assert running.exit_code() == code, (running.stdout, running.stderr)
        assert "Traceback" not in running.stderr
        return running

    def close(self) -> None:
        for running in self._started:
            running.close()


@pytest.fixture
def ros2(domain: int, tmp_path: Path) -> Iterator[Ros2]:
    """Start the command."""
    ros2 = Ros2(domain, tmp_path)
    yield ros2
    ros2.close()


@pytest.fixture
def overlay(ros2: Ros2, tmp_path: Path) -> Path:
    """Folder of the executables of an installed package ``demo``, whose path has a space in it."""
    prefix = tmp_path / "my install"
    marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / "demo"
    marker.parent.mkdir(parents=True)
    marker.touch()
    (prefix / "share" / "demo" / "launch").mkdir(parents=True)
    executables = prefix / "lib" / "demo"
    executables.mkdir(parents=True)
    ros2.environment["AMENT_PREFIX_PATH"] = os.pathsep.join([str(prefix), os.environ.get("AMENT_PREFIX_PATH", "")])
    return executables


@pytest.fixture
def program(overlay: Path):
    """Write an executable of the package ``demo`` in Python."""

    def write(name: str, code: str) -> Path:
        path = overlay / name
        # A shell that becomes Python: the interpreter's path may have a space, which no #! line can hold.
        path.write_text(f"#!/bin/sh\n''''exec '{sys.executable}' \"$0\" \"$@\" # '''\n{code}")
        path.chmod(0o755)
        return path

    return write
