"""Node of the whole arm: poses and twists of the tip to joints, by inverse kinematics."""

from __future__ import annotations

import time
from collections import deque

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistStamped
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from sensor_msgs.msg import JointState

from continuum.kinematics.compiled.warm_up import warm_up
from continuum.kinematics.fabrikc_tracking import FabrikcTracker
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.tracking import Tracked, Tracker
from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.arm_joints import arm_joint_names, arm_joint_values
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.stamps import NANOSECONDS, StampJoiner, nanoseconds, seconds
from continuum_manipulator.tip_targets import BASE_FRAME, TipPose, TipTwist, read_pose, read_twist
from continuum_msgs.msg import IkStatus as IkStatusMessage

TWIST_PATIENCE = 0.5
"""Time by the machine's clock for which a pose waits for its twist [s]."""

WORDS = {
    IkStatus.LIMIT_REACHED: "a bend limit keeps the arm from the pose",
    IkStatus.UNREACHABLE: "pose out of reach",
    IkStatus.NO_CONVERGENCE: "inverse kinematics did not converge",
}


class RobotNode(CheckedNode):
    """Converts ``traj_pose`` and ``traj_twist`` to ``joint_states`` and ``ik_status``.

    A pose and a twist with the same stamp are answered together. Without a publisher of twists, a pose is answered at
    once without velocities; if its twist does not arrive, it is answered after half a second. Without a publisher of
    poses, twists are integrated. A pose out of reach is answered with the nearest pose found.
    """

    NAME = "robot"
    PARAMETERS = (
        ParameterSpec(
            "target", str, "part of the pose that the tip follows; the direction is the pose's z axis",
            default="position", choices=("position", "position_direction"),
        ),
        ParameterSpec(
            "solver", str, "solver of poses: Gauss-Newton with restarts, or the thesis's FABRIKc",
            default="newton", choices=("newton", "fabrikc"),
        ),
        ParameterSpec(
            "max_iterations", int, "most pairs of a backward and a forward pass of fabrikc for one pose",
            lower=1, upper=100000, default=100,
        ),
        ParameterSpec(
            "tolerance", float, "largest distance in m, and angle in rad, of a reached pose",
            lower=1e-12, upper=1.0, default=1e-9,
        ),
        ParameterSpec(
            "max_twist_gap", float, "longest time between two stamps over which motion is continued", "s", 0.0, 3600.0,
            lower_open=True, default=0.5,
        ),
    )  # fmt: skip
    HAS_ARM = True

    def __init__(self) -> None:
        super().__init__()
        warm_up()  # before the first pose arrives
        self._tracker = self._tracker_of_choice()
        self._joints = list(arm_joint_names(self.arm))
        self._max_gap = round(self.values["max_twist_gap"] * NANOSECONDS)
        self._last: int | None = None
        self._pairs: StampJoiner[str, TipPose | TipTwist] = StampJoiner(("pose", "twist"))
        self._waiting: deque[tuple[float, TipPose]] = deque()
        self.diagnostics.values |= {
            "poses and twists given up without their partner": lambda: self._pairs.incomplete + self._pairs.late,
            "poses and twists waiting for their partner": lambda: self._pairs.waiting,
        }
        self._publish_joints = self.offer(JointState, "joint_states")
        self._publish_status = self.offer(IkStatusMessage, "ik_status")
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._patience_timer = self.create_timer(TWIST_PATIENCE / 10, self._answer_alone, clock=steady)
        self._poses = self.listen(PoseStamped, "traj_pose", self._on_pose)
        self._twists = self.listen(TwistStamped, "traj_twist", self._on_twist)

    def in_words(self) -> str:
        """Describe the solver."""
        return f"solver {self.values['solver']}"

    def _tracker_of_choice(self) -> Tracker:
        use_direction, tolerance = self.values["target"] == "position_direction", self.values["tolerance"]
        if self.values["solver"] == "fabrikc":
            return FabrikcTracker(self.arm, use_direction, tolerance, self.values["max_iterations"])
        return Tracker(self.arm, use_direction, tolerance)

    def _on_pose(self, message: PoseStamped) -> None:
        pose = read_pose(message)
        if self._twists.get_publisher_count() == 0:
            self._answer(pose, None)
        else:
            self._waiting.append((time.monotonic() + TWIST_PATIENCE, pose))
            self._join("pose", pose)

    def _on_twist(self, message: TwistStamped) -> None:
        twist = read_twist(message)
        if self._poses.get_publisher_count() == 0:
            self._integrate(twist)
        else:
            self._join("twist", twist)

    def _join(self, source: str, target: TipPose | TipTwist) -> None:
        pair = self._pairs.add(source, nanoseconds(target.stamp), target)
        if pair is not None:
            self._answer(pair["pose"], pair["twist"])

    def _answer_alone(self) -> None:
        """Answer poses whose twists do not arrive: a node that advertises twists may never send one."""
        while self._waiting and self._waiting[0][0] <= time.monotonic():
            _, pose = self._waiting.popleft()
            stamp = nanoseconds(pose.stamp)
            if self._pairs.withdraw("pose", stamp, pose):
                self.diagnostics.warnings.note(
                    "poses answered without their twist", f"at {seconds(stamp)}: no twist of this stamp on traj_twist"
                )
                self._answer(pose, None)

    def _answer(self, pose: TipPose, twist: TipTwist | None) -> None:
        velocity, angular_velocity = (None, None) if twist is None else (twist.linear, twist.angular)
        dt = self._time_since_last(pose.stamp)
        self._publish(self._tracker.pose(pose.position, pose.direction, velocity, angular_velocity, dt), pose.stamp)

    def _integrate(self, twist: TipTwist) -> None:
        """Integrate a twist; the first one, and one after a gap, starts the motion at the present posture."""
        dt = self._time_since_last(twist.stamp)
        self._publish(self._tracker.twist(twist.linear, twist.angular, 0.0 if dt is None else dt), twist.stamp)

    def _time_since_last(self, stamp: Time) -> float | None:
        """Return the time since the previous answer [s]; None if the motion does not continue it."""
        now = nanoseconds(stamp)
        gap = None if self._last is None else now - self._last
        self._last = now
        return gap / NANOSECONDS if gap is not None and 0 < gap <= self._max_gap else None

    def _publish(self, tracked: Tracked, stamp: Time) -> None:
        result = tracked.result
        positions, velocities = arm_joint_values(result.configuration, tracked.rate, self.arm)
        joints = JointState(name=self._joints, position=positions)
        joints.header.stamp = stamp
        if velocities is not None:
            joints.velocity = velocities
        status = IkStatusMessage(
            status=int(result.status), distance=result.distance, angle=result.angle, iterations=result.iterations
        )
        status.header.stamp = stamp
        status.header.frame_id = BASE_FRAME
        self._publish_joints(joints)
        self._publish_status(status)
        if not result.solved:
            self.diagnostics.warnings.note(
                WORDS[result.status], f"the nearest pose found is used, {1e3 * result.distance:.3f} mm away"
            )
