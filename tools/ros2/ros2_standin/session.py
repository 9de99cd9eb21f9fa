"""A short-lived node of the command, with the waiting functions of the verbs."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future

from ros2_standin.end_signals import ends_are_received
from ros2_standin.errors import UserError

_POLL = 0.05
"""Longest time between two checks of the graph or of a pending interrupt [s]."""

_SETTLED = 0.5
"""Time without a change after which the graph counts as known [s]."""


class Session:
    """A node and its executor, spun explicitly so that an interrupt takes effect at once.

    Attributes:
        node: the command's node; its name starts with ``_``, so that it is hidden.
        spin_time: longest time that discovery may take [s].
    """

    def __init__(self, node: Node, executor: SingleThreadedExecutor, spin_time: float) -> None:
        self.node = node
        self.spin_time = spin_time
        self._executor = executor

    def spin_until(self, done: Callable[[], bool], timeout: float | None = None) -> bool:
        """Serve callbacks until ``done()``; return False after ``timeout`` [s] (None waits forever)."""
        deadline = None if timeout is None else time.monotonic() + timeout
        while not done():
            if deadline is not None and time.monotonic() >= deadline:
                return False
            self._spin_once()
        return True

    def _spin_once(self) -> None:
        with ends_are_received() as raise_again:
            try:
                self._executor.spin_once(timeout_sec=_POLL)
            finally:
                raise_again()

    def spin_for(self, duration: float) -> None:
        """Serve callbacks for ``duration`` [s]."""
        self.spin_until(lambda: False, duration)

    def discover(self, wanted: Callable[[], bool] | None = None) -> None:
        """Wait until the graph is known: ``wanted()`` holds if given, and the graph has not changed for some time.

        The wait is never longer than ``spin_time``.
        """
        seen: object = None
        since = time.monotonic()

        def settled() -> bool:
            nonlocal seen, since
            now = (sorted(self.node.get_node_names_and_namespaces()), sorted(self.node.get_topic_names_and_types()))
            if now != seen:
                seen, since = now, time.monotonic()
            ready = wanted() if wanted else len(now[0]) > 1
            return ready and time.monotonic() - since >= _SETTLED

        self.spin_until(settled, self.spin_time)

    def result(self, future: Future, timeout: float | None, what: str) -> object:
        """Return the future's result.

        Raises:
            UserError: it did not arrive within ``timeout`` [s].
        """
        if not self.spin_until(future.done, timeout):
            raise UserError(f"No answer from {what} within {timeout:g} s")
        return future.result()


@contextmanager
def open_session(args: argparse.Namespace, name: str | None = None, use_sim_time: bool = False) -> Iterator[Session]:
    """Open a session that ends with the block.

    Args:
        args: parsed command line: ``ros_args`` and, where the verb has it, ``spin_time``.
        name: name of the node, by default a hidden one.
        use_sim_time: follow ``/clock``.

    Raises:
        UserError: the ``--ros-args`` are wrong.
    """
    parameters = [rclpy.Parameter("use_sim_time", value=True)] if use_sim_time else []
    try:
        # Python's handlers remain: an interrupt is a KeyboardInterrupt, and cli.main returns its exit code.
        rclpy.init(args=args.ros_args, signal_handler_options=SignalHandlerOptions.NO)
        node = rclpy.create_node(
            name or f"_ros2cli_{os.getpid()}", start_parameter_services=False, parameter_overrides=parameters
        )
    except (rclpy.exceptions.InvalidNodeNameException, rclpy.exceptions.InvalidNamespaceException) as error:
        rclpy.try_shutdown()
        raise UserError(" ".join(str(error).split())) from error
    except RuntimeError as error:
        raise UserError(f"ROS could not be started with {args.ros_args}: {str(error).splitlines()[0]}") from error
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        yield Session(node, executor, getattr(args, "spin_time", 2.0))
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


def add_discovery_arguments(parser: argparse.ArgumentParser) -> None:
    """``--spin-time`` and the stock options about a daemon, which this command never has."""
    parser.add_argument(
        "--spin-time",
        type=nonnegative_float,
        default=2.0,
        metavar="S",
        help="Longest time in seconds to wait for discovery; it ends earlier once the graph is steady (default: 2)",
    )
    parser.add_argument("--no-daemon", action="store_true", help="Changes nothing here: there is no daemon")


def nonnegative_float(text: str) -> float:
    """A number >= 0, for argparse."""
    return _number(text, float, least_included=True)


def positive_float(text: str) -> float:
    """A number > 0, for argparse."""
    return _number(text, float, least_included=False)


def nonnegative_int(text: str) -> int:
    """A whole number >= 0, for argparse."""
    return int(_number(text, int, least_included=True))


def positive_int(text: str) -> int:
    """A whole number > 0, for argparse."""
    return int(_number(text, int, least_included=False))


def _number(text: str, kind: type[float | int], least_included: bool) -> float:
    try:
        value = kind(text)
    except ValueError:
        value = kind(-1)
    good = 0 <= value < float("inf") and (least_included or value > 0)
    if not good:
        word = "whole number" if kind is int else "number"
        raise argparse.ArgumentTypeError(f"{text!r}; allowed: a {word} {'>=' if least_included else '>'} 0")
    return value
