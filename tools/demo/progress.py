"""Progress of the demo: count of received cable states."""

from __future__ import annotations

import time
from collections.abc import Callable

import rclpy
from rclpy.context import Context
from rclpy.experimental.events_executor import EventsExecutor
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from continuum_manipulator.nodekit.qos import STREAM
from continuum_msgs.msg import CableStates

START_TIMEOUT = 90.0
"""Longest time until the first cable state [s]."""

STALL_TIMEOUT = 20.0
"""Longest time between cable states [s]."""

CHECK_PERIOD = 0.5
"""Time between two checks of the nodes [s]."""


def follow(domain: int, n_poses: int, check: Callable[[], None]) -> bool:
    """Show progress until ``n_poses`` cable states have arrived or messages stop; return True if all have arrived.

    Args:
        domain: ROS domain of the nodes.
        n_poses: number of expected cable states.
        check: function called regularly; its exceptions end the wait.
    """
    context = Context()
    rclpy.init(context=context, domain_id=domain)  # separate: Python's signal handlers remain
    try:
        node = rclpy.create_node("demo_progress", context=context)
        count = 0

        def on_message(_: bytes) -> None:
            nonlocal count
            count += 1

        node.create_subscription(CableStates, "cable_states", on_message, STREAM, raw=True)
        executor = EventsExecutor(context=context)
        executor.add_node(node)
        with _bar() as progress:
            task = progress.add_task("starting the nodes", total=n_poses)
            deadline, next_check, before = time.monotonic() + START_TIMEOUT, 0.0, 0
            while count < n_poses and time.monotonic() < deadline:
                executor.spin_once(timeout_sec=0.2)
                if count > before:
                    deadline, before = time.monotonic() + STALL_TIMEOUT, count
                    progress.update(task, completed=count, description="following the poses")
                if time.monotonic() > next_check:
                    check()
                    next_check = time.monotonic() + CHECK_PERIOD
        return count >= n_poses
    finally:
        rclpy.try_shutdown(context=context)


def _bar() -> Progress:
    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.completed}/{task.total} poses"),
        TimeRemainingColumn(),
    )
