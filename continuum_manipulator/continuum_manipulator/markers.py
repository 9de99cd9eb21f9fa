"""Node that shows cables and curvature in RViz (thesis appendix A, Fig. 14)."""

from __future__ import annotations

import time

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Vector3
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from sensor_msgs.msg import JointState
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from continuum.arrays import Array
from continuum.cable_colours import Colour, cable_colour
from continuum.kinematics.cable_lines import CableLine, cable_lines, curvature_arrows
from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.arm_joints import arm_joint_names
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.qos import REPORT
from continuum_manipulator.nodekit.stamps import NANOSECONDS
from continuum_manipulator.section_joints import read_bends, read_names
from continuum_manipulator.tip_targets import BASE_FRAME

ARROW_COLOUR = (0.6, 0.0, 0.8)


class MarkersNode(CheckedNode):
    """Converts ``joint_states`` to ``cable_markers`` and ``section_config_markers``, at most ``rate`` times a second.

    A cable is a line through the holes of the discs, whose poses follow from the angles of the individual joints; it is
    thinner where it only passes through a section. The rotation vector of a section is an arrow at its centre of
    curvature; a straight section has none.
    """

    NAME = "markers"
    PARAMETERS = (
        ParameterSpec("rate", float, "most markers per second", "Hz", 0.0, 1000.0, lower_open=True, default=30.0),
        ParameterSpec("line_width", float, "width of a cable's line", "m", 0.0, 1.0, lower_open=True, default=0.0015),
        ParameterSpec(
            "arrow_scale", float, "length of the curvature arrow for a bend of 1 rad", "m/rad", 0.0, 10.0,
            lower_open=True, default=0.05,
        ),
        ParameterSpec(
            "longest_radius", float, "radius of curvature beyond which a section counts as straight", "m", 0.0, 1e6,
            lower_open=True, default=5.0,
        ),
    )  # fmt: skip
    HAS_ARM = True

    def __init__(self) -> None:
        super().__init__()
        self._bends: dict[int, Array] = {}
        self._stamp = Time()
        self._next = time.monotonic()
        self._publish_cables = self.offer(MarkerArray, "cable_markers", REPORT)
        self._publish_arrows = self.offer(MarkerArray, "section_config_markers", REPORT)
        draw = self.checked("joint_states", self._draw)
        self._due = self.create_timer(
            1.0 / self.values["rate"], lambda: draw(self._stamp), clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self._due.cancel()
        self.listen(JointState, "joint_states", self._on_joints)

    def _on_joints(self, message: JointState) -> None:
        """Read the joints of every message, since sections may arrive separately; draw when the rate allows it."""
        index = read_names(message)
        read = {i: read_bends(index, message.position, section) for i, section in enumerate(self.arm.sections)}
        found = {i: bends for i, bends in read.items() if bends is not None}
        if not found:
            raise messages.nothing_known("joint", message.name, arm_joint_names(self.arm))
        self._bends |= found
        self._stamp = message.header.stamp
        if len(self._bends) == self.arm.n_sections and self._due.is_canceled():
            self._due.timer_period_ns = max(1, round((self._next - time.monotonic()) * NANOSECONDS))
            self._due.reset()

    def _draw(self, stamp: Time) -> None:
        self._due.cancel()
        self._next = time.monotonic() + 1.0 / self.values["rate"]
        bends = [self._bends[i] for i in range(self.arm.n_sections)]
        self._publish_cables(MarkerArray(markers=self._cable_markers(bends, stamp)))
        self._publish_arrows(MarkerArray(markers=self._arrow_markers(bends, stamp)))

    def _cable_markers(self, bends: list[Array], stamp: Time) -> list[Marker]:
        return [self._cable_marker(i, line, stamp) for i, line in enumerate(cable_lines(bends, self.arm))]

    def _cable_marker(self, number: int, line: CableLine, stamp: Time) -> Marker:
        marker = _marker("cables", number, Marker.LINE_STRIP, cable_colour(line.colour_index), stamp)
        marker.scale.x = self.values["line_width"] * (0.5 if line.passing else 1.0)
        marker.points = _points(line.points)
        return marker

    def _arrow_markers(self, bends: list[Array], stamp: Time) -> list[Marker]:
        arrows = curvature_arrows(bends, self.arm, self.values["arrow_scale"], self.values["longest_radius"])
        markers = []
        for i, arrow in enumerate(arrows):
            marker = _marker("rotation_vectors", i, Marker.ARROW, ARROW_COLOUR, stamp)
            width = 3 * self.values["line_width"]
            marker.scale = Vector3(x=width, y=2 * width, z=3 * width)  # shaft, head, length of the head
            if arrow is None:
                marker.action = Marker.DELETE
            else:
                marker.points = _points(arrow)
            markers.append(marker)
        return markers


def _marker(namespace: str, number: int, kind: int, colour: Colour, stamp: Time) -> Marker:
    red, green, blue = colour
    marker = Marker(ns=namespace, id=number, type=kind, action=Marker.ADD)
    marker.header = Header(stamp=stamp, frame_id=BASE_FRAME)
    marker.color = ColorRGBA(r=red, g=green, b=blue, a=1.0)
    marker.pose.orientation.w = 1.0
    return marker


def _points(array: Array) -> list[Point]:
    return [Point(x=x, y=y, z=z) for x, y, z in array.tolist()]
