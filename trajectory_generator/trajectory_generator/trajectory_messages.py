"""Poses and twists of a trajectory as messages, sampled in blocks, so that a long trajectory needs little memory."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, Twist, TwistStamped, Vector3
from std_msgs.msg import Header

from trajectory_generator.trajectory import Trajectory

FRAME = "base_link"
_BLOCK = 1024


class TrajectoryMessages:
    """The messages of a trajectory at a rate.

    Args:
        trajectory: the trajectory.
        rate: instants per second [Hz].

    Raises:
        InvalidValueError: the rate gives too many instants.
    """

    def __init__(self, trajectory: Trajectory, rate: float) -> None:
        self._trajectory = trajectory
        self._times = trajectory.times(rate)
        self._first = -_BLOCK
        self._rows: list[tuple[list[float], ...]] = []

    def __len__(self) -> int:
        return len(self._times)

    @property
    def duration(self) -> float:
        """Time of the last instant [s]."""
        return float(self._times[-1])

    def at(self, i: int, stamp: Time) -> tuple[PoseStamped, TwistStamped]:
        """Return pose and twist of instant ``i``, both with ``stamp``."""
        if not self._first <= i < self._first + _BLOCK:
            self._first = i - i % _BLOCK
            sample = self._trajectory.sample(self._times[self._first : self._first + _BLOCK])
            fields = (sample.position, sample.quaternion, sample.linear_velocity, sample.angular_velocity)
            self._rows = list(zip(*(field.tolist() for field in fields), strict=True))
        position, quaternion, linear, angular = self._rows[i - self._first]
        header = Header(stamp=stamp, frame_id=FRAME)
        pose = Pose(position=_filled(Point(), position), orientation=_filled(Quaternion(), quaternion))
        twist = Twist(linear=_filled(Vector3(), linear), angular=_filled(Vector3(), angular))
        return PoseStamped(header=header, pose=pose), TwistStamped(header=header, twist=twist)


def _filled[Message: (Point, Quaternion, Vector3)](message: Message, values: list[float]) -> Message:
    for name, value in zip("xyzw", values, strict=False):
        setattr(message, name, value)
    return message
