"""Poses of the links of an arm's description as tf2 transforms, joint by joint, as robot_state_publisher has them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, TransformStamped, Vector3
from scipy.spatial.transform import Rotation
from tf2_msgs.msg import TFMessage

from continuum.arrays import Array
from continuum.errors import InvalidValueError

TURNING = ("revolute", "continuous")


class _Turning(NamedTuple):
    """A turning joint: its transform at angle 0, its unit axis (3,), and what it mimics: joint, multiplier, offset."""

    name: str
    transform: TransformStamped
    origin: Array  # quaternion (4,), real part last
    axis: Array
    mimic: tuple[str, float, float] | None


class LinkTransforms:
    """The transform from each link of a description to its parent link.

    Args:
        text: a URDF, whose joints are fixed, revolute or continuous.
        prefix: prefix of the name of every frame.

    Attributes:
        fixed: transforms of the fixed joints, without a stamp.

    Raises:
        InvalidValueError: the text is no such URDF.
    """

    def __init__(self, text: str, prefix: str = "") -> None:
        self.fixed = TFMessage()
        self._turning: list[_Turning] = []
        try:
            joints = ElementTree.fromstring(text).findall("joint")
            for joint in joints:
                self._add(joint, prefix)
        except (ElementTree.ParseError, AttributeError, KeyError, TypeError, ValueError) as error:
            raise InvalidValueError("robot_description", text[:40], f"a URDF ({error})") from error

    def moved(self, angles: Mapping[str, float], stamp: Time) -> TFMessage:
        """Return the transforms of the joints with known ``angles`` [rad].

        A joint that mimics another one follows it unless its own angle is known.
        """
        known, values = [], []
        for joint in self._turning:
            angle = angles.get(joint.name)
            if angle is None and joint.mimic is not None and joint.mimic[0] in angles:
                mimicked, multiplier, offset = joint.mimic
                angle = multiplier * angles[mimicked] + offset
            if angle is not None:
                known.append(joint)
                values.append(angle)
        if not known:
            return TFMessage()
        turned = np.array(values)[:, None] * np.array([joint.axis for joint in known])
        turns = Rotation.from_quat([joint.origin for joint in known]) * Rotation.from_rotvec(turned)
        for joint, (x, y, z, w) in zip(known, turns.as_quat(canonical=True).tolist(), strict=True):
            joint.transform.header.stamp = stamp
            joint.transform.transform.rotation = Quaternion(x=x, y=y, z=z, w=w)
        return TFMessage(transforms=[joint.transform for joint in known])

    def _add(self, joint: ElementTree.Element, prefix: str) -> None:
        origin = joint.find("origin")
        x, y, z = _numbers(origin, "xyz", "0 0 0")
        turn = Rotation.from_euler("xyz", _numbers(origin, "rpy", "0 0 0"))  # about fixed axes, as a URDF has them
        transform = TransformStamped(child_frame_id=prefix + joint.find("child").attrib["link"])
        transform.header.frame_id = prefix + joint.find("parent").attrib["link"]
        transform.transform.translation = Vector3(x=x, y=y, z=z)
        quaternion = turn.as_quat(canonical=True)
        transform.transform.rotation = Quaternion(**dict(zip("xyzw", quaternion.tolist(), strict=True)))
        kind = joint.attrib["type"]
        if kind == "fixed":
            self.fixed.transforms.append(transform)
            return
        if kind not in TURNING:
            raise ValueError(f"joint {joint.attrib['name']} is {kind}; allowed: fixed, {', '.join(TURNING)}")
        axis = np.array(_numbers(joint.find("axis"), "xyz", "1 0 0"))
        mimic = joint.find("mimic")
        follows = None
        if mimic is not None:
            follows = mimic.attrib["joint"], float(mimic.get("multiplier", "1")), float(mimic.get("offset", "0"))
        self._turning.append(
            _Turning(joint.attrib["name"], transform, quaternion, axis / np.linalg.norm(axis), follows)
        )


def _numbers(element: ElementTree.Element | None, name: str, default: str) -> list[float]:
    """Return three finite numbers of an attribute."""
    text = default if element is None else element.get(name, default)
    numbers = [float(word) for word in text.split()]
    if len(numbers) != 3 or not all(map(math.isfinite, numbers)):
        raise ValueError(f'{name}="{text}" is not three numbers')
    return numbers
