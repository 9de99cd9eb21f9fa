"""Frames as a listener of tf2 puts them together, without tf2."""

from collections.abc import Iterable

import numpy as np
from geometry_msgs.msg import TransformStamped
from scipy.spatial.transform import Rotation


class FrameTree:
    """Transforms of one instant; no frame has two parents."""

    def __init__(self, transforms: Iterable[TransformStamped]) -> None:
        self._parents: dict[str, tuple[str, np.ndarray]] = {}
        for one in transforms:
            assert one.child_frame_id not in self._parents, f"{one.child_frame_id} twice"
            place, turn = one.transform.translation, one.transform.rotation
            step = np.eye(4)
            step[:3, :3] = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w]).as_matrix()
            step[:3, 3] = place.x, place.y, place.z
            self._parents[one.child_frame_id] = one.header.frame_id, step

    @property
    def frames(self) -> set[str]:
        return {*self._parents} | {parent for parent, _ in self._parents.values()}

    def roots(self) -> set[str]:
        """Frames from which all others hang, without a circle: a tree has one."""
        return {self._path(frame)[0] for frame in self.frames}

    def pose(self, frame: str) -> np.ndarray:
        """Pose (4, 4) [m] in the root."""
        return self._path(frame)[1]

    def _path(self, frame: str) -> tuple[str, np.ndarray]:
        pose, passed = np.eye(4), 0
        while frame in self._parents:
            frame, step = self._parents[frame]
            pose, passed = step @ pose, passed + 1
            assert passed <= len(self._parents), "a circle"
        return frame, pose
