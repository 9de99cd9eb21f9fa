"""Poses of the links of an arm: forward kinematics of its description from angles of named joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.spatial.transform import Rotation
from yourdfpy import URDF, Joint

from continuum.arrays import Array
from continuum.errors import InvalidValueError


class LinkPoses:
    """Forward kinematics of a description whose joints are revolute or fixed.

    A joint that mimics another follows it unless its angle is given: the bending joints of a section may differ.

    Args:
        description: description of the arm.

    Attributes:
        links: names of the links, each after its parent.
        joints: names of the revolute joints.

    Raises:
        InvalidValueError: a joint has another type.
    """

    def __init__(self, description: URDF) -> None:
        order = _parents_first(description)
        self.links = [root_link(description), *(joint.child for joint in order)]
        self.joints = [joint.name for joint in order if joint.type != "fixed"]
        for joint in order:
            if joint.type not in ("fixed", "revolute", "continuous"):
                raise InvalidValueError(f"type of joint {joint.name}", joint.type, "fixed, revolute or continuous")
        number = {link: i for i, link in enumerate(self.links)}
        turning = {name: i for i, name in enumerate(self.joints)}
        self._parents = [number[joint.parent] for joint in order]
        self._origins = np.array([np.eye(4) if joint.origin is None else joint.origin for joint in order])
        self._turns = np.flatnonzero([joint.type != "fixed" for joint in order])
        self._axes = np.array([joint.axis for joint in order if joint.type != "fixed"]).reshape(-1, 3)
        self._followers = [
            (turning[joint.name], turning[joint.mimic.joint], joint.mimic.multiplier or 1.0, joint.mimic.offset or 0.0)
            for joint in order
            if joint.mimic is not None
        ]

    def angles(self, named: Mapping[str, float]) -> Array:
        """Return the angles of all joints, (n_joints,) [rad]; 0 for a joint that is not named and mimics none."""
        angles: Array = self.angles_over(tuple(named), np.array([list(named.values())], dtype=float))[0]
        return angles

    def angles_over(self, names: Sequence[str], values: Array) -> Array:
        """Return the angles of all joints at several instants, (n, n_joints) [rad], as `angles` for each.

        Args:
            names: names of the known joints; those of no joint here do not count.
            values: their angles, (n, n_names) [rad].
        """
        column = {name: i for i, name in enumerate(names)}
        angles = np.full((len(values), len(self.joints)), np.nan)
        for joint, name in enumerate(self.joints):
            if name in column:
                angles[:, joint] = values[:, column[name]]
        for joint, mimicked, multiplier, offset in self._followers:
            followed = multiplier * np.nan_to_num(angles[:, mimicked]) + offset
            angles[:, joint] = np.where(np.isnan(angles[:, joint]), followed, angles[:, joint])
        known: Array = np.nan_to_num(angles)
        return known

    def poses(self, angles: Array) -> Array:
        """Return the link poses in the base link, (..., n_links, 4, 4) [m], at ``angles``, (..., n_joints) [rad]."""
        instants = angles.shape[:-1]
        steps = np.broadcast_to(self._origins, (*instants, *self._origins.shape)).copy()
        turns = Rotation.from_rotvec((angles[..., None] * self._axes).reshape(-1, 3)).as_matrix()
        turned = turns.reshape(*instants, len(self._turns), 3, 3)
        steps[..., self._turns, :3, :3] = steps[..., self._turns, :3, :3] @ turned
        poses = np.empty((*instants, len(self.links), 4, 4))
        poses[..., 0, :, :] = np.eye(4)
        for i, parent in enumerate(self._parents):
            poses[..., i + 1, :, :] = poses[..., parent, :, :] @ steps[..., i, :, :]
        return poses


def root_link(description: URDF) -> str:
    """Return the name of the link that is the child of no joint.

    Raises:
        InvalidValueError: there is no such link, or more than one.
    """
    carried = {joint.child for joint in description.robot.joints}
    roots = [link.name for link in description.robot.links if link.name not in carried]
    if len(roots) != 1:
        raise InvalidValueError("links that no joint carries", roots, "one")
    return str(roots[0])


def _parents_first(description: URDF) -> list[Joint]:
    """Return the joints, each after the joint of its parent link."""
    waiting, known, order = list(description.robot.joints), {root_link(description)}, []
    while waiting:
        ready = [joint for joint in waiting if joint.parent in known]
        if not ready:
            raise InvalidValueError("joints of the description", [joint.name for joint in waiting], "one tree")
        order += ready
        known |= {joint.child for joint in ready}
        waiting = [joint for joint in waiting if joint.child not in known]
    return order
