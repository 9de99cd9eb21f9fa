"""Node that shows the arm in a browser and publishes the commands of its users."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from sensor_msgs.msg import JointState

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import ContinuumError
from continuum.parameter_spec import ParameterSpec
from continuum.viewer.address import HOST, PORT
from continuum.viewer.default_arm import default_arm
from continuum.viewer.layout import NAME
from continuum.viewer.page import FRAME_RATE, Page
from continuum.viewer.remote_arm import RemoteArm
from continuum.viewer.seen import Status
from continuum.viewer.tension_controls import TensionControls
from continuum_manipulator.arm_joints import arm_joint_names, arm_joint_values
from continuum_manipulator.newest import Newest
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.occasional_publisher import OccasionalPublisher
from continuum_manipulator.nodekit.qos import NEWEST, REPORT
from continuum_manipulator.nodekit.stamps import nanoseconds
from continuum_manipulator.tip_targets import BASE_FRAME, read_pose
from continuum_manipulator.topic_arbiter import TopicArbiter
from continuum_manipulator.viewer_messages import read_angles, read_cables, read_statuses
from continuum_msgs.msg import CableStates

STALE_AFTER = 3.0
"""Time without repetition after which a status is stale [s]."""

MOST_STATUSES = 60

SLACK_TIME = 0.5
"""Duration for which slack cables are commanded after control is returned [s]."""

JOINTS, TARGETS, TENSIONS = "joint_states", "traj_pose", "cable_tension_cmd"
"""Topics on which users of the page may publish."""


class NotDrawnError(ContinuumError):
    """The page is no longer drawn."""


class ViewerNode(CheckedNode):
    """``joint_states``, ``cable_states``, ``traj_pose`` and ``/diagnostics`` on a page for browsers.

    If ``simulated/joint_states`` are published beside measured ones, the simulated arm is shown as well, and the
    measured one as a ghost. A user may take control: a dragged target is published on ``traj_pose``, sliders of joints
    on ``joint_states``, sliders of tensions on ``cable_tension_cmd``, but not while another node publishes there, nor
    after the user's browser has disconnected. Each topic is advertised only while a user commands through it: a bench
    refuses all commands while two nodes advertise them. Without an arm in the parameters, the arm of three sections is
    used.
    """

    NAME = "viewer"
    PARAMETERS = (
        ParameterSpec("host", str, "address to serve on; the default is reachable from this host only", default=HOST),
        ParameterSpec("port", int, "port of the page; 0 for any free port", lower=0, upper=65535, default=PORT),
        ParameterSpec("simulated", str, "namespace of a simulated arm beside the measured one", default="simulated"),
        ParameterSpec("max_tension", float, "largest tension that a slider commands", "N", 0.0, 1e4, default=30.0),
    )  # fmt: skip
    HAS_ARM = True

    @classmethod
    def default_arm(cls) -> Arm:
        return default_arm()

    def __init__(self) -> None:
        super().__init__()
        self._remote = RemoteArm(self.arm, self.values["max_tension"])
        self._joints = list(arm_joint_names(self.arm))
        self._known, self._cables = frozenset(self._joints), list(self.arm.cable_names)
        self._statuses: dict[str, tuple[float, Status]] = {}
        self._pulled_until = -float("inf")
        host, port = self.values["host"], self.values["port"]
        self._page = Page(self.arm, self._remote, host, port, self.diagnostics.faults, title=f"live - {NAME}")
        self.diagnostics.values |= {
            "address": lambda: self._page.address,
            "browsers": lambda: self._page.browsers,
            "frames": lambda: self._page.frames,
        }
        self._arbiters = {topic: TopicArbiter() for topic in (JOINTS, TARGETS, TENSIONS)}
        self._publish_target = self.offer_at_times(PoseStamped, TARGETS)
        self._publish_joints = self.offer_at_times(JointState, JOINTS)
        self._publish_tensions = self.offer_at_times(CableStates, TENSIONS)
        self._newest = Newest[tuple[Callable[[Any], None], Any]]()
        self._refresh(JointState, JOINTS, self._on_joints)
        self._refresh(JointState, f"{self.values['simulated']}/joint_states", self._on_simulated)
        self._refresh(CableStates, "cable_states", self._on_cables)
        self._refresh(PoseStamped, TARGETS, self._on_target)
        self.listen(CableStates, TENSIONS, lambda message: self._hear(TENSIONS, message), NEWEST)
        self.listen(DiagnosticArray, "/diagnostics", self._on_diagnostics, REPORT)
        self.create_timer(1.0 / FRAME_RATE, self._act, clock=Clock(clock_type=ClockType.STEADY_TIME))
        self._stop = threading.Event()
        self._drawing = threading.Thread(target=self._page.run, args=(self._stop,), name="drawing", daemon=True)
        self._drawing.start()

    def in_words(self) -> str:
        return f"open {self._page.address} in a browser"

    def close(self) -> None:
        self._stop.set()
        self._drawing.join()
        self._page.close()
        super().close()

    def _refresh(self, message_type: type, topic: str, handle: Callable[[Any], None]) -> None:
        """Subscribe; only the latest message about the same names is processed in each frame."""
        checked = self.checked(topic, handle)

        def keep(message: Any) -> None:
            if topic in self._arbiters:
                self._hear(topic, message)
            self._newest.keep((topic, *getattr(message, "name", ())), (checked, message))

        self.listen(message_type, topic, keep, NEWEST)

    def _on_joints(self, message: JointState) -> None:
        angles = {**self._remote.latest.joints, **read_angles(message, self._known)}
        self._remote.tell(joints=angles, time=time.monotonic())

    def _on_simulated(self, message: JointState) -> None:
        angles = {**self._remote.latest.simulated, **read_angles(message, self._known)}
        self._remote.tell(simulated=angles, time=time.monotonic())

    def _on_cables(self, message: CableStates) -> None:
        lengths, tensions = read_cables(message, self._cables)
        self._remote.tell(lengths=lengths, tensions=tensions, time=time.monotonic())

    def _on_target(self, message: PoseStamped) -> None:
        self._remote.tell(target=read_pose(message).position)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        now = time.monotonic()
        self._statuses |= {name: (now, status) for name, status in read_statuses(message).items()}
        for name in list(self._statuses)[:-MOST_STATUSES]:
            del self._statuses[name]
        shown = [
            status if now - received < STALE_AFTER else replace(status, level=3, message="silent")
            for _, (received, status) in sorted(self._statuses.items())
        ]
        self._remote.tell(statuses=tuple(shown))

    def _act(self) -> None:
        """Process received messages and publish the user's commands.

        Raises:
            NotDrawnError: the drawing thread has ended, so the page and its commands are out of date.
        """
        if not self._drawing.is_alive():
            raise NotDrawnError("the page is no longer drawn, for the reason above")
        for handle, message in self._newest.take():
            handle(message)
        remote = self._remote
        remote.let_go()
        if remote.target is not None:
            self._move_target(remote.target)
        else:
            self._publish_target.withdraw()
        if remote.posture is not None:
            self._move_joints(remote.posture)
        else:
            self._publish_joints.withdraw()
        if remote.tensions is not None:
            self._move_cables(remote.tensions)

    def _move_cables(self, tensions: TensionControls) -> None:
        """Publish tensions while control is taken, and slack cables for `SLACK_TIME` afterwards."""
        wanted, now = tensions.wanted(), time.monotonic()
        if tensions.taken:
            self._pulled_until = now + SLACK_TIME
        if wanted and now < self._pulled_until:
            self._pull(wanted)
        else:
            self._publish_tensions.withdraw()

    def _move_target(self, target: Array) -> None:
        pose = PoseStamped()
        pose.header.frame_id = BASE_FRAME
        point = pose.pose.position
        point.x, point.y, point.z = target.tolist()
        self._say(TARGETS, self._publish_target, pose)

    def _move_joints(self, w: Array) -> None:
        message = JointState(name=self._joints, position=arm_joint_values(w, None, self.arm)[0])
        self._say(JOINTS, self._publish_joints, message)

    def _pull(self, wanted: Mapping[str, float]) -> None:
        message = CableStates(section=CableStates.WHOLE_ARM, name=list(wanted), effort=list(wanted.values()))
        self._say(TENSIONS, self._publish_tensions, message)

    def _hear(self, topic: str, message: Any) -> None:
        self._arbiters[topic].received(nanoseconds(message.header.stamp), time.monotonic())

    def _say(self, topic: str, publish: OccasionalPublisher, message: Any) -> None:
        """Publish with a stamp, unless another node publishes on the topic, which is reported."""
        arbiter, now = self._arbiters[topic], time.monotonic()
        if arbiter.is_taken(now):
            self.diagnostics.warnings.note(f"{topic} not from the page", "another node publishes them")
            publish.withdraw()
        if not arbiter.may_speak(now):
            return
        message.header.stamp = self.get_clock().now().to_msg()
        arbiter.said(nanoseconds(message.header.stamp))
        publish(message)
