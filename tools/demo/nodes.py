"""The nodes of the demo: launch them together, follow them to the last pose, and end them in any case."""

from __future__ import annotations

import os
import re
import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from tools.demo.errors import DemoError
from tools.demo.progress import follow

END_TIMEOUT = 20.0
"""Time for the nodes to end by themselves [s]."""

_CRASH = re.compile(r"^\[ERROR\] \[(?P<label>[^\]]+)\]: process has died \[pid \d+, exit code (?P<code>-?\d+)", re.M)


def run_nodes(
    trajectory_file: Path, arm_file: Path, out: Path, domain: int, n_poses: int, solver: str = "newton"
) -> bool:
    """Run `arm.launch.py` with its recorder until all poses have become cable states; True if they did.

    Raises:
        DemoError: a node died, or the launch ended.
    """
    command = ["ros2", "launch", "trajectory_generator", "arm.launch.py"]
    files = {"arm": arm_file.resolve(), "trajectory": trajectory_file.resolve(), "record": out / "recording"}
    command += [f"solver:={solver}", *(f"{name}:={path}" for name, path in files.items())]
    log_file = out / "nodes.log"
    with log_file.open("w", encoding="utf-8") as log, launched(command, domain, log.fileno()) as launch:
        return follow(domain, n_poses, checker(launch, log_file))


def checker(launch: subprocess.Popen[bytes], log_file: Path) -> Callable[[], None]:
    """Return a check of a launch with a log: it raises `DemoError` when a node has died or the launch has ended."""

    def check() -> None:
        text = log_file.read_text(encoding="utf-8", errors="replace")
        crash = _CRASH.search(text)
        if crash:
            raise DemoError(f"{crash['label']} died: {_last_words(text, crash)}; see {log_file}")
        if launch.poll() is not None:
            raise DemoError(f"the launch ended: {(text.strip() or 'silently').splitlines()[-1]}; see {log_file}")

    return check


def _last_words(text: str, crash: re.Match[str]) -> str:
    """Return the last output and the exit code of a dead node."""
    said = re.findall(rf"^\[{re.escape(crash['label'])}\] (.*\S)", text[: crash.start()], re.M)
    return f"{said[-1] if said else 'without a word'} (exit code {crash['code']})"


@contextmanager
def launched(command: list[str], domain: int, log: int) -> Iterator[subprocess.Popen[bytes]]:
    """Run a launch during the block, and interrupt it at the end as by Ctrl-C."""
    environment = os.environ | {"ROS_DOMAIN_ID": str(domain)}
    launch = subprocess.Popen(command, stdout=log, stderr=subprocess.STDOUT, env=environment, start_new_session=True)
    try:
        yield launch
    finally:
        with _undisturbed():
            stop(launch)


def stop(launch: subprocess.Popen[bytes]) -> None:
    """Interrupt the launch and wait until every node has ended."""
    if launch.poll() is None:
        os.killpg(launch.pid, signal.SIGINT)
    try:
        launch.wait(timeout=END_TIMEOUT)
    except subprocess.TimeoutExpired:
        os.killpg(launch.pid, signal.SIGKILL)
        launch.wait()


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Defer signals while the nodes are ended."""
    came: list[int] = []
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    for number, handler in before.items():
        signal.signal(number, signal.SIG_IGN if handler is signal.SIG_IGN else lambda taken, _: came.append(taken))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    if came:
        raise KeyboardInterrupt
