"""One running process of a launch: its lines, its signals, its end."""

from __future__ import annotations

import asyncio
import contextlib
import ctypes
import os
import signal
import subprocess
from collections.abc import Callable
from typing import BinaryIO

from ros2_standin.launch.processes import ProcessSpec
from ros2_standin.launch.screen import Screen

_PR_SET_PDEATHSIG = 1
_CHUNK = 65536
_LEFTOVER_TIME = 1.0
"""Longest wait for output after the process's end, where a helper of it still holds the pipe [s]."""


def dies_with_parent() -> Callable[[], None]:
    """What a new process must call before its program begins, so that it never outlives this one."""
    libc = ctypes.CDLL(None, use_errno=True)
    parent = os.getpid()

    def bind() -> None:
        libc.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
        if os.getppid() != parent:
            os._exit(1)

    return bind


async def _end_of(process: subprocess.Popen[bytes]) -> None:
    """Wait for the end of a process, whatever may still hold its pipes."""
    loop = asyncio.get_running_loop()
    ended = asyncio.Event()
    handle = os.pidfd_open(process.pid)
    loop.add_reader(handle, ended.set)
    try:
        await ended.wait()
    finally:
        loop.remove_reader(handle)
        os.close(handle)


class Child:
    """A process.

    Args:
        label: its name with its number in the launch.

    Attributes:
        returncode: negative after a signal.
    """

    def __init__(self, spec: ProcessSpec, label: str, screen: Screen) -> None:
        self.spec = spec
        self.label = label
        self.returncode = 0
        self._screen = screen
        self._process: subprocess.Popen[bytes] | None = None
        self._stopping = asyncio.Event()

    async def run(self) -> None:
        """Start the process and stay with it to its end.

        Raises:
            OSError: it cannot be started.
        """
        # Not asyncio's own subprocess: in Python 3.12 it takes a process for alive while a helper holds its pipes.
        process = subprocess.Popen(
            self.spec.command,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            # A session of its own: a terminal's Ctrl-C reaches it through us alone, once.
            start_new_session=True,
            preexec_fn=dies_with_parent(),
        )
        self._process = process
        self._screen.say("info", self.label, f"process started with pid [{process.pid}]")
        readers = [
            asyncio.create_task(self._pass_on(process.stdout, self.spec.stdout_to_screen)),
            asyncio.create_task(self._pass_on(process.stderr, self.spec.stderr_to_screen)),
        ]
        if self._stopping.is_set():
            self._send(signal.SIGINT)
        await _end_of(process)
        # Helpers that it left behind end with it; its number, not yet given back, still names their group alone.
        self._send(signal.SIGKILL)
        self.returncode = code = process.wait()
        _, late = await asyncio.wait(readers, timeout=_LEFTOVER_TIME)
        for reader in late:
            reader.cancel()
        self._process = None
        if code == 0:
            self._screen.say("info", self.label, f"process has finished cleanly [pid {process.pid}]")
        else:
            what = f"[pid {process.pid}, exit code {code}, cmd '{self.spec.line}']"
            self._screen.say("error", self.label, f"process has died {what}.")

    async def _pass_on(self, pipe: BinaryIO, shown: bool) -> None:
        reader = asyncio.StreamReader()
        transport, _ = await asyncio.get_running_loop().connect_read_pipe(
            lambda: asyncio.StreamReaderProtocol(reader), pipe
        )
        with contextlib.closing(transport):
            await self._pass_lines_on(reader, shown)

    async def _pass_lines_on(self, reader: asyncio.StreamReader, shown: bool) -> None:
        rest = b""
        while chunk := await reader.read(_CHUNK):
            *lines, rest = (rest + chunk).split(b"\n")
            for line in lines:
                self._line(line, shown)
        if rest:
            self._line(rest, shown)

    def _line(self, line: bytes, shown: bool) -> None:
        self._screen.line(f"[{self.label}] {line.decode(errors='replace').rstrip(chr(13))}", shown)

    def _send(self, number: signal.Signals) -> None:
        """Signal the process and its helpers."""
        if self._process is not None:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, number)

    async def stop(self, done: asyncio.Task) -> None:
        """End the process, ever more firmly, until the task ``done`` of its ``run`` is over."""
        self._stopping.set()
        patience = ((signal.SIGINT, self.spec.interrupt_time), (signal.SIGTERM, self.spec.terminate_time))
        for i, (number, seconds) in enumerate(patience):
            if self._process is not None:
                self._screen.say("info", self.label, f"sending signal '{number.name}' to process[{self.label}]")
            self._send(number)
            await asyncio.wait([done], timeout=seconds)
            if done.done():
                return
            self._screen.say(
                "error",
                self.label,
                f"process[{self.label}] failed to terminate '{seconds:g}' seconds after receiving '{number.name}', "
                f"escalating to '{('SIGTERM', 'SIGKILL')[i]}'",
            )
        self._send(signal.SIGKILL)
        await asyncio.wait([done])
