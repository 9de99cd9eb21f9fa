"""Poses of the sections' bases, discs and tips as tf2 transforms from ``base_link``."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from scipy.spatial.transform import Rotation
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.discs import arm_disc_poses
from continuum_manipulator.tip_targets import BASE_FRAME


def disc_transforms(bends: Sequence[Array], arm: Arm, stamp: Time, prefix: str = "") -> TFMessage:
    """Return the frames of the arm's description that do not rotate with phi, each as a child of ``base_link``.

    Args:
        bends: for each section the bends of its joints, (n_joints, 2) [rad].
        arm: the arm.
        stamp: stamp of the joint states.
        prefix: prefix of the name of every frame, including ``base_link``.
    """
    frames = [frame for section in arm.sections for frame in section.disc_frames]
    poses = np.concatenate(arm_disc_poses(bends, arm))
    turns = Rotation.from_matrix(poses[:, :3, :3]).as_quat(canonical=True)
    header = Header(stamp=stamp, frame_id=prefix + BASE_FRAME)
    return TFMessage(
        transforms=[
            TransformStamped(
                header=header,
                child_frame_id=prefix + frame,
                transform=Transform(translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)),
            )
            for frame, (x, y, z), (qx, qy, qz, qw) in zip(frames, poses[:, :3, 3].tolist(), turns.tolist(), strict=True)
        ]
    )
