"""Commands to the nodes of the demo: services and tensions over time, with their answers."""

from __future__ import annotations

import time
from collections.abc import Callable
from itertools import pairwise
from types import TracebackType
from typing import Any

import numpy as np
import rclpy
from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from continuum.arrays import Array
from continuum.joint_names import cable_names
from continuum_manipulator.nodekit.qos import STREAM
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds
from continuum_msgs.msg import CableStates
from continuum_msgs.srv import ResetArm
from tools.demo.bench.runs import Run
from tools.demo.errors import DemoError

PERIOD = 1 / 60
"""Time between two tension commands [s]."""

PATIENCE = 30.0
"""Longest wait for a node, an answer or a message [s]."""

STATES = {"measured": "joint_states", "simulated": "simulated/joint_states"}


class Conductor:
    """Commander of the demo; a context manager that closes its node.

    Args:
        domain: ROS domain.
        check: function called while waiting; its exceptions end the wait.

    Attributes:
        received: joint states since the last clearing, as (stamp [ns], joint angles (n,) [rad]), by `STATES`.
    """

    def __init__(self, domain: int, check: Callable[[], None]) -> None:
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = rclpy.create_node("bench_demo", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._check = check
        self._say = self._node.create_publisher(CableStates, "cable_tension_cmd", STREAM)
        self.received: dict[str, list[tuple[int, Array]]] = {name: [] for name in STATES}
        for name, topic in STATES.items():
            self._node.create_subscription(JointState, topic, lambda m, n=name: self._keep(n, m), STREAM)

    def __enter__(self) -> Conductor:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        self._executor.shutdown()
        self._node.destroy_node()
        rclpy.try_shutdown(context=self._context)

    def wait_until(self, condition: Callable[[], object], what: str) -> None:
        """Process messages until ``condition`` holds.

        Raises:
            DemoError: it does not hold within `PATIENCE`.
        """
        deadline = time.monotonic() + PATIENCE
        while not condition():
            self._check()
            if time.monotonic() > deadline:
                raise DemoError(f"waited {PATIENCE:g} s in vain for {what}")
            self._executor.spin_once(timeout_sec=0.05)

    def listen(self, duration: float) -> None:
        """Process messages for a ``duration`` [s]."""
        end = time.monotonic() + duration
        self.wait_until(lambda: time.monotonic() >= end, "the clock")

    def wait_for_states(self) -> None:
        """Wait for joint states of both arms."""
        for received in self.received.values():
            received.clear()
        self.wait_until(lambda: all(self.received.values()), "joint states of both arms")

    def trigger(self, service: str, patient: bool = False) -> str:
        """Call a service and return its answer; if ``patient``, repeat the call until it succeeds.

        Raises:
            DemoError: the service failed.
        """
        deadline = time.monotonic() + PATIENCE
        while True:
            answer = self._call(Trigger, service, Trigger.Request())
            if answer.success:
                return str(answer.message)
            if not patient or time.monotonic() > deadline:
                raise DemoError(f"{service}: {answer.message}")
            self.listen(0.3)

    @property
    def is_active(self) -> bool:
        """Whether the bridge is active."""
        state = self._call(GetState, "bench_bridge/get_state", GetState.Request()).current_state
        return bool(state.id == State.PRIMARY_STATE_ACTIVE)

    def activate(self) -> None:
        """Activate the bridge unless it is active; the bench ends the claim of a bridge that was silent for too long.

        Raises:
            DemoError: the bridge refuses, again and again.
        """
        request = ChangeState.Request(transition=Transition(id=Transition.TRANSITION_ACTIVATE))
        deadline = time.monotonic() + PATIENCE
        while not self.is_active:
            if not self._call(ChangeState, "bench_bridge/change_state", request).success:
                if time.monotonic() > deadline:
                    raise DemoError("bench_bridge cannot be activated; nodes.log has the reason")
                self.listen(0.3)

    @property
    def largest_gap(self) -> float:
        """Return the longest time without measured joint states since the last clearing [s]; 0 if none were known."""
        stamps = [stamp for stamp, _ in self.received["measured"]]
        return max((later - earlier for earlier, later in pairwise(stamps)), default=0) / NANOSECONDS

    def place_simulated_arm(self) -> None:
        """Place the simulated arm at rest in the posture of the bench's arm."""
        self.wait_for_states()
        posture = self.received["measured"][-1][1]
        self._call(ResetArm, "simulated/dynamics/reset", ResetArm.Request(position=posture.tolist()))

    def carry_out(self, run: Run) -> None:
        """Pull as specified by a run, release both arms if the run does, and wait for its end."""
        begin = time.monotonic()
        while (t := time.monotonic() - begin) < run.pulled:
            self._command(run.pull(t))
            self.listen(PERIOD)
        if run.released:
            calls = [self._begin(Trigger, f"{node}/release") for node in ("bench_bridge", "simulated/dynamics")]
            self.wait_until(lambda: all(call.done() for call in calls), "the release")
            failed = [call.result().message for call in calls if not call.result().success]
            if failed:
                raise DemoError(f"release: {'; '.join(failed)}")
        else:
            self._command(np.zeros(2))
        self.listen(run.after)

    def _command(self, tensions: Array) -> None:
        message = CableStates(name=list(cable_names("section_1", 2)), effort=tensions)
        message.header.stamp = self._node.get_clock().now().to_msg()
        self._say.publish(message)

    def _call(self, kind: type, service: str, request: Any) -> Any:
        call = self._begin(kind, service, request)
        self.wait_until(call.done, f"an answer of {service}")
        return call.result()

    def _begin(self, kind: type, service: str, request: Any = None) -> Any:
        client = self._node.create_client(kind, service)
        self.wait_until(client.service_is_ready, f"the service {service}")
        return client.call_async(request or kind.Request())

    def _keep(self, name: str, message: JointState) -> None:
        self.received[name].append((nanoseconds(message.header.stamp), np.array(message.position[1:-1])))


def side_by_side(received: dict[str, list[tuple[int, Array]]]) -> tuple[Array, Array, Array]:
    """Return times since the first measurement (n,) [s], measured and simulated angles, (n, n_joints) each [rad]."""
    measured, simulated = (received[name] for name in ("measured", "simulated"))
    stamps, known = (np.array([stamp for stamp, _ in arm]) for arm in (measured, simulated))
    table = np.array([angles for _, angles in simulated])
    at = np.stack([np.interp(stamps, known, column) for column in table.T], axis=1)
    return (stamps - stamps[0]) / NANOSECONDS, np.array([angles for _, angles in measured]), at
