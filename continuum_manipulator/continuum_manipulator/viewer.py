"""Node that shows the arm in a browser, and lets whoever looks move it."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping
from dataclasses import replace

from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from sensor_msgs.msg import JointState

from continuum.arm import Arm
from continuum.parameter_spec import ParameterSpec
from continuum.viewer.page import FRAME_RATE, HOST, PORT, Page
from continuum.viewer.remote_arm import RemoteArm
from continuum.viewer.seen import Status
from continuum.viewer.usual_arm import usual_arm
from continuum_manipulator.arm_joints import arm_joint_names, arm_joint_values
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.qos import NEWEST, REPORT
from continuum_manipulator.tip_targets import BASE_FRAME, read_pose
from continuum_manipulator.viewer_messages import read_angles, read_cables, read_statuses
from continuum_msgs.msg import CableStates

STALE_AFTER = 3.0
"""A status that was not repeated for so long is stale [s]."""

MOST_STATUSES = 60

SLACK_TIME = 0.5
"""For so long slack cables are commanded once control is given back [s]."""


class ViewerNode(CheckedNode):
    """``joint_states``, ``cable_states``, ``traj_pose`` and ``/diagnostics`` on a page for browsers.

    Of a simulated arm beside a measured one, ``simulated/joint_states`` are shown too, and the measured one as a
    ghost. Whoever looks may take control: a target that is dragged is published on ``traj_pose``, sliders of joints
    on ``joint_states`` unless another node speaks there, sliders of tensions on ``cable_tension_cmd``. Without an arm
    in the parameters, it is the one of three sections.
    """

    NAME = "viewer"
    PARAMETERS = (
        ParameterSpec("host", str, "address that the page is served on; the default is this host alone", default=HOST),
        ParameterSpec("port", int, "port of the page, 0 for any that is free", lower=0, upper=65535, default=PORT),
        ParameterSpec("simulated", str, "namespace of a simulated arm beside the measured one", default="simulated"),
        ParameterSpec("max_tension", float, "largest tension that a slider asks for", "N", 0.0, 1e4, default=30.0),
    )  # fmt: skip
    HAS_ARM = True

    @classmethod
    def default_arm(cls) -> Arm:
        return usual_arm()

    def __init__(self) -> None:
        super().__init__()
        self._remote = RemoteArm(self.arm, self.values["max_tension"])
        self._joints = list(arm_joint_names(self.arm))
        self._known, self._cables = frozenset(self._joints), list(self.arm.cable_names)
        self._statuses: dict[str, tuple[float, Status]] = {}
        self._pulled_until = -float("inf")
        self._page = Page(self.arm, self._remote, self.values["host"], self.values["port"])
        self.diagnostics.values |= {
            "address": lambda: self._page.address,
            "browsers": lambda: self._page.lookers,
            "frames": lambda: self._page.frames,
        }
        self._publish_target = self.offer(PoseStamped, "traj_pose")
        self._publish_joints = self.offer(JointState, "joint_states")
        self._publish_tensions = self.offer(CableStates, "cable_tension_cmd")
        self.listen(JointState, "joint_states", self._on_joints, NEWEST)
        self.listen(JointState, f"{self.values['simulated']}/joint_states", self._on_simulated, NEWEST)
        self.listen(CableStates, "cable_states", self._on_cables, NEWEST)
        self.listen(PoseStamped, "traj_pose", self._on_target, NEWEST)
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

    def _on_joints(self, message: JointState) -> None:
        angles = {**self._remote.told.joints, **read_angles(message, self._known)}
        self._remote.tell(joints=angles, time=time.monotonic())

    def _on_simulated(self, message: JointState) -> None:
        angles = {**self._remote.told.simulated, **read_angles(message, self._known)}
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
            status if now - heard < STALE_AFTER else replace(status, level=3, message="silent")
            for _, (heard, status) in sorted(self._statuses.items())
        ]
        self._remote.tell(statuses=tuple(shown))

    def _act(self) -> None:
        """Publish what whoever looks wants of the arm."""
        if not self._page.lookers:
            self._remote.let_go()
        remote, stamp = self._remote, self.get_clock().now().to_msg()
        if remote.target is not None:
            pose = PoseStamped()
            pose.header.stamp, pose.header.frame_id = stamp, BASE_FRAME
            point = pose.pose.position
            point.x, point.y, point.z = remote.target.tolist()
            self._publish_target(pose)
        if remote.posture is not None:
            if self.count_publishers("joint_states") > 1:
                self.diagnostics.warnings.note("joints not moved", "another node publishes joint_states")
            else:
                joints = JointState(name=self._joints, position=arm_joint_values(remote.posture, None, self.arm)[0])
                joints.header.stamp = stamp
                self._publish_joints(joints)
        if remote.tensions is not None:
            wanted, now = remote.tensions.wanted(), time.monotonic()
            if remote.tensions.taken:
                self._pulled_until = now + SLACK_TIME
            if now < self._pulled_until:
                self._pull(wanted)

    def _pull(self, wanted: Mapping[str, float]) -> None:
        message = CableStates(section=CableStates.WHOLE_ARM, name=list(wanted), effort=list(wanted.values()))
        message.header.stamp = self.get_clock().now().to_msg()
        self._publish_tensions(message)
