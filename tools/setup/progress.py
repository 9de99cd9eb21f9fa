"""Run the commands of one step: a short line for the user, everything else to the log."""

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from contextlib import ExitStack
from pathlib import Path
from types import TracebackType
from typing import IO, Self

from tools.setup.layout import LOG_FILE, ROOT, SetupError

TAIL_LINES = 25

_SIGN_OF_LIFE = 10.0
"""Time between two dots where the line cannot be written again [s]."""


class Step:
    """One line of progress, e.g. ``  180 pinned packages ... 31 s``; a context manager for its commands.

    A terminal shows the running time, a file or a pipe one more dot every ten seconds.
    """

    def __init__(self, title: str, hint: str) -> None:
        """Args: title: what is done. hint: what to try when it fails."""
        self._title = title
        self._hint = hint
        self._start = time.monotonic()
        self._dots = 0
        self._live = sys.stdout.isatty()

    def __enter__(self) -> Self:
        print(f"  {self._title} ...", end="", flush=True)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        self._show(f" {'failed after ' if error else ''}{time.monotonic() - self._start:.0f} s\n")

    def run(self, command: Sequence[str | Path], environment: dict[str, str]) -> None:
        """Run ``command`` in the checkout and wait.

        Raises:
            SetupError: the command failed; the message contains the end of its output.
        """
        self.run_together([command], environment)

    def run_together(self, commands: Sequence[Sequence[str | Path]], environment: dict[str, str]) -> None:
        """Run commands at the same time in the checkout, and wait for all; the log has the output of each as a whole.

        Raises:
            SetupError: a command failed; the message contains the end of its output. The others are ended.
        """
        LOG_FILE.parent.mkdir(exist_ok=True)
        with ExitStack() as stack:
            log = stack.enter_context(LOG_FILE.open("a", encoding="utf-8"))
            running: list[tuple[subprocess.Popen[bytes], IO[str], str]] = []
            for command in commands:
                output = stack.enter_context(tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace"))
                running.append(
                    (self._started(command, environment, output, stack), output, " ".join(map(str, command)))
                )
            while running:
                self._wait(running[0][0])
                for process, output, words in [one for one in running if one[0].poll() is not None]:
                    running.remove((process, output, words))
                    output.seek(0)
                    text = output.read()
                    log.write(f"$ {words}\n{text}")
                    if process.returncode:
                        end = [*text.splitlines()[-TAIL_LINES:], "", f"error: {self._title}: {self._hint}"]
                        raise SetupError("\n".join(["", *end, f"Log: {LOG_FILE}"]))

    def _started(
        self, command: Sequence[str | Path], environment: dict[str, str], output: IO[str], stack: ExitStack
    ) -> subprocess.Popen[bytes]:
        try:
            process = subprocess.Popen(
                command,
                cwd=ROOT,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                process_group=0,
            )
        except OSError as error:
            raise SetupError(f"{command[0]} cannot be started: {error.strerror}") from error
        stack.enter_context(process)
        stack.callback(_end, process)
        return process

    def _wait(self, process: subprocess.Popen[bytes]) -> None:
        try:
            process.wait(timeout=1)
        except subprocess.TimeoutExpired:
            seconds = time.monotonic() - self._start
            if self._live:
                self._show(f" {seconds:.0f} s")
            elif seconds > _SIGN_OF_LIFE * (self._dots + 1):
                self._dots += 1
                self._show(".")

    def _show(self, text: str) -> None:
        print(f"\r  {self._title} ...{text}" if self._live else text, end="", flush=True)


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a command that still runs, with all that it started."""
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGTERM)
