"""Run the commands of one step: a short line for the user, everything else to the log."""

import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

from tools.setup.layout import LOG_FILE, ROOT, SetupError

TAIL_LINES = 25


class Step:
    """One line of progress, e.g. ``  180 pinned packages ........ 31 s``; a context manager for its commands."""

    def __init__(self, title: str, hint: str) -> None:
        """Args: title: what is done. hint: what to try when it fails."""
        self._title = title
        self._hint = hint
        self._start = time.monotonic()
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
        LOG_FILE.parent.mkdir(exist_ok=True)
        with LOG_FILE.open("a+", encoding="utf-8", errors="replace") as log:
            log.write(f"$ {' '.join(map(str, command))}\n")
            log.flush()
            beginning = log.tell()
            try:
                process = subprocess.Popen(
                    command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT
                )
            except OSError as error:
                raise SetupError(f"{command[0]} cannot be started: {error.strerror}") from error
            with process:
                while process.poll() is None:
                    self._wait(process)
            if process.returncode:
                log.seek(beginning)
                end = log.read().splitlines()[-TAIL_LINES:]
                raise SetupError("\n".join(["", *end, "", f"error: {self._title}: {self._hint}", f"Log: {LOG_FILE}"]))

    def _wait(self, process: subprocess.Popen[bytes]) -> None:
        try:
            process.wait(timeout=1)
        except subprocess.TimeoutExpired:
            if self._live:
                self._show(f" {time.monotonic() - self._start:.0f} s")

    def _show(self, text: str) -> None:
        print(f"\r  {self._title} ...{text}" if self._live else text, end="", flush=True)
