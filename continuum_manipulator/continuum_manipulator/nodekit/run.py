"""Run a node from the command line until its end, without a traceback.

Only the standard library is imported at the top: signals are caught before the slow imports start, so that a node that
is stopped in its first seconds ends as cleanly as later.
"""

from __future__ import annotations

import importlib
import os
import signal
import sys
from types import FrameType, TracebackType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from continuum_manipulator.nodekit.checked_node import CheckedNode

BAD_START = 2
"""Exit code of a node that did not start: its parameters or arguments are wrong."""

FAILED = 1
"""Exit code of a node that had to give up while running."""


HELP = frozenset(("-h", "--help"))
"""Arguments that ask for the usage."""


class StopRequest:
    """True after SIGINT or SIGTERM. A launcher may send several; only the first has an effect.

    As a context manager, it restores the signal handlers at the end.
    """

    def __init__(self) -> None:
        self._came = False
        self._before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def __enter__(self) -> StopRequest:
        for number in self._before:
            signal.signal(number, self._take)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def __bool__(self) -> bool:
        return self._came

    def _take(self, _number: int, _frame: FrameType | None) -> None:
        self._came = True


def run(node: str) -> int:
    """Run the node ``package.module:Class`` until a signal arrives or the node is finished.

    Returns:
        The exit code: 0, also for ``--help``; or, with one line on stderr, :data:`BAD_START` or :data:`FAILED`.
    """
    with StopRequest() as stop:
        # Discovery stays on this host unless the user configures it otherwise.
        os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        module, _, name = node.partition(":")
        node_class = getattr(importlib.import_module(module), name)
        return _run(node_class, stop)


def _run(node_class: type[CheckedNode], stop: StopRequest) -> int:
    import rclpy
    from rclpy.logging import LoggingSeverity, set_logger_level
    from rclpy.signals import SignalHandlerOptions
    from rclpy.utilities import remove_ros_args

    from continuum.errors import ContinuumError
    from continuum_manipulator.nodekit.start_errors import START_ERRORS, one_line
    from continuum_manipulator.nodekit.usage import usage

    set_logger_level("rcl", LoggingSeverity.FATAL)  # its message duplicates the error line below
    try:
        extra = remove_ros_args(sys.argv)[1:]
        if not HELP.isdisjoint(extra):
            print(usage(node_class))
            return 0
        if extra:
            return _fail(node_class, f"unknown argument {extra[0]!r}; parameters go after --ros-args as -p name:=value")
        rclpy.init(args=sys.argv, signal_handler_options=SignalHandlerOptions.NO)
        node = node_class()
        node.refuse_unknown_overrides()
        node.greet()
    except START_ERRORS as error:
        rclpy.try_shutdown()
        return _fail(node_class, one_line(error))
    try:
        _spin(node, stop)
        node.close()
        return 0
    except ContinuumError as error:
        return _fail(node_class, node.give_up(one_line(error)), FAILED)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _spin(node: CheckedNode, stop: StopRequest) -> None:
    """Serve the node. This executor needs a sixth of the others' processor time, but must be polled with a time-out."""
    from rclpy.experimental import EventsExecutor

    executor = EventsExecutor()
    executor.add_node(node)
    while not (stop or node.finished) or node.draining():
        executor.spin_once(timeout_sec=0.2)
    executor.remove_node(node)


def _fail(node_class: type[CheckedNode], problem: str, code: int = BAD_START) -> int:
    print(f"{node_class.NAME}: error: {problem}", file=sys.stderr)
    return code
