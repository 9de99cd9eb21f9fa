"""Runs the processes of a launch together, from the first to the last end."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Iterable

from ros2_standin.errors import UserError
from ros2_standin.launch.child import Child
from ros2_standin.launch.launch_file import errors_in_one_line
from ros2_standin.launch.processes import ProcessSpec
from ros2_standin.launch.python_api import LaunchContext, OnProcessExit, ProcessExited
from ros2_standin.launch.screen import Screen

_SIGNALS = {
    signal.SIGINT: "user interrupted with ctrl-c (SIGINT)",
    signal.SIGTERM: "asked to end (SIGTERM)",
    signal.SIGHUP: "the terminal is gone (SIGHUP)",
}


async def supervise(processes: list[ProcessSpec], exit_handlers: Iterable[OnProcessExit] = ()) -> int:
    """Start everything, pass its lines on, and end when the last process ends, or all of them when asked to.

    Returns:
        0, also after an interrupt or the death of a process, as the stock launch; 1 if a process could not be started,
        or a handler raised something, which ends the launch.
    """
    return await _Supervisor(exit_handlers).run(processes)


class _Supervisor:
    def __init__(self, exit_handlers: Iterable[OnProcessExit]) -> None:
        self._exit_handlers = exit_handlers
        self._ending = asyncio.Event()
        self._screen = Screen(on_broken=self._ending.set)
        self._failed = False

    async def run(self, processes: list[ProcessSpec]) -> int:
        loop = asyncio.get_running_loop()
        for number in _SIGNALS:
            if signal.getsignal(number) is not signal.SIG_IGN:
                loop.add_signal_handler(number, self._signalled, number)
        self._screen.say("info", "launch", f"All log files can be found below {self._screen.folder}")
        children = [Child(process, f"{process.name}-{i}", self._screen) for i, process in enumerate(processes, start=1)]
        tasks = [asyncio.create_task(self._attend(child)) for child in children]
        if tasks:
            await asyncio.wait(tasks)
        self._screen.close()
        return 1 if self._failed else 0

    def _signalled(self, number: signal.Signals) -> None:
        text = _SIGNALS[number]
        self._screen.say("warning", "launch", f"{text} again, ignoring..." if self._ending.is_set() else text)
        self._ending.set()

    async def _attend(self, child: Child) -> None:
        """One process from its start to its end, which an end of the launch brings about."""
        running = asyncio.create_task(child.run())
        ending = asyncio.create_task(self._ending.wait())
        await asyncio.wait([running, ending], return_when=asyncio.FIRST_COMPLETED)
        if not running.done():
            await child.stop(running)
        ending.cancel()
        if (error := running.exception()) is not None:
            if not isinstance(error, OSError):
                raise error
            self._failed = True
            self._screen.say("error", "launch", f"'{child.spec.line}' cannot be started: {error.strerror or error}")
            self._ending.set()
            return
        try:
            self._report_exit(child)
        except UserError as error:
            self._failed = True
            self._screen.say("error", "launch", str(error))
            self._ending.set()

    def _report_exit(self, child: Child) -> None:
        """Call the launch files' handlers.

        Raises:
            UserError: one of them raised something.
        """
        event = ProcessExited(child.label, child.returncode)
        context = LaunchContext(is_shutdown=self._ending.is_set())
        with errors_in_one_line():
            for handler in self._exit_handlers:
                if handler.target_action is None or handler.target_action is child.spec.action:
                    handler.on_exit(event, context)
