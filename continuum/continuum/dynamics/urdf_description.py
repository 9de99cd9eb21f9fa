"""A URDF's links in rigid groups, and the joints that rotate them, from the base to the tip."""

from __future__ import annotations

import io
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import yourdfpy

from continuum.arrays import Array
from continuum.errors import FileError

_TURNING = ("revolute", "continuous")
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_UNREADABLE = (
    SyntaxError,
    RecursionError,
    KeyError,
    AttributeError,
    TypeError,
    ValueError,
    yourdfpy.urdf.URDFError,
)
"""Exceptions of yourdfpy on a damaged description."""

_EXPAND = "expand it first: xacro ARM.urdf.xacro > ARM.urdf"
_XACRO_MARKS = (b"${", b"xacro:")
_XACRO_DEFINITIONS = ("property", "arg", "macro")
"""Elements of xacro that alone put nothing into a description."""


@dataclass(frozen=True)
class Body:
    """Mass [kg], centre of mass (3,) [m] and inertia about it (3, 3) [kg m2] in the root's frame."""

    mass: float
    centre: Array
    inertia: Array


@dataclass
class Group:
    """Links fixed to each other: their bodies, the positions of their frames (3,) [m], and joints to other groups."""

    bodies: list[Body]
    frames: dict[str, Array]
    turning: list[tuple[yourdfpy.Joint, Array]]


class Description:
    """Links and joints of a file.

    Args:
        path: path of the URDF.

    Raises:
        FileError: the file cannot be read, or its links do not form a tree.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            data = path.read_bytes()
        except OSError as error:
            raise FileError(path, f"cannot be read ({error.strerror or error})") from error
        if b"<!DOCTYPE" in data:
            raise FileError(path, "has a document type declaration, which descriptions must not have")
        try:
            root = ElementTree.fromstring(data)
            _without_namespaces(path, root)
            robot = yourdfpy.URDF.load(
                io.BytesIO(ElementTree.tostring(root)),
                build_scene_graph=False, load_meshes=False, build_collision_scene_graph=False,
            ).robot  # fmt: skip
        except _UNREADABLE as error:
            hint = f"; {_EXPAND}" if any(mark in data for mark in _XACRO_MARKS) else ""
            raise FileError(path, f"cannot be read as a URDF ({type(error).__name__}: {error}){hint}") from error
        _check_text(path, root)
        self._links = {link.name: link for link in robot.links}
        self._beyond: dict[str, list[yourdfpy.urdf.Joint]] = {name: [] for name in self._links}
        for joint in robot.joints:
            if joint.parent not in self._links or joint.child not in self._links:
                raise FileError(path, f"has a joint {joint.name} between undefined links")
            self._beyond[joint.parent].append(joint)
        moved = [joint.child for joint in robot.joints]
        roots = sorted(self._links.keys() - set(moved))
        if len(roots) != 1 or len(set(moved)) != len(moved):
            raise FileError(path, f"is not a tree of links: its roots are {', '.join(roots) or 'none'}")
        self._root = roots[0]

    def chain(self) -> tuple[list[yourdfpy.urdf.Joint], Array, list[Array], list[Group]]:
        """Return the joints from base to tip, their axes (n, 3), their positions (3,) [m], and the moved groups."""
        joints, axes, places, groups = list[yourdfpy.urdf.Joint](), list[Array](), list[Array](), list[Group]()
        group = self._fixed_to(self._root, np.eye(4))
        while group.turning:
            if len(group.turning) > 1:
                names = ", ".join(joint.name for joint, _ in group.turning)
                raise FileError(self._path, f"branches into the joints {names}; a single chain is needed")
            joint, pose = group.turning[0]
            group = self._fixed_to(joint.child, pose)
            joints.append(joint)
            axes.append(pose[:3, :3] @ _axis(self._path, joint))
            places.append(pose[:3, 3])
            groups.append(group)
        if not joints:
            raise FileError(self._path, f"has no rotary joint ({' or '.join(_TURNING)})")
        return joints, np.array(axes), places, groups

    def _fixed_to(self, name: str, pose: Array) -> Group:
        """Return the group of a link at a pose (4, 4) [m] and of all links fixed to it."""
        group, waiting = Group([], {}, []), [(name, pose)]
        while waiting:
            name, pose = waiting.pop(0)
            inertial = self._links[name].inertial
            group.frames[name] = pose[:3, 3]
            if inertial is not None:
                group.bodies.append(_body(self._path, name, inertial, pose))
            for joint in self._beyond[name]:
                at = pose if joint.origin is None else pose @ joint.origin
                if joint.type == "fixed":
                    waiting.append((joint.child, at))
                elif joint.type in _TURNING and joint.mimic is None:
                    group.turning.append((joint, at))
                else:
                    kind = "coupled to another one (mimic)" if joint.mimic is not None else joint.type
                    allowed = ", ".join((*_TURNING, "fixed"))
                    raise FileError(self._path, f"has the joint {joint.name}, which is {kind}; allowed: {allowed}")
        return group


def _without_namespaces(path: Path, root: ElementTree.Element) -> None:
    """Rename elements to their names without namespace, as a namespace does not change what a URDF says.

    Definitions of xacro that were left over are taken out; what xacro would put in the place of others is missing.

    Raises:
        FileError: the root is no ``robot``, or has elements that xacro has not replaced.
    """
    for element in list(root):
        if _of_xacro(element) in _XACRO_DEFINITIONS:
            root.remove(element)
    for element in root.iter():
        if name := _of_xacro(element):
            raise FileError(path, f"has the element xacro:{name}; {_EXPAND}")
        element.tag = str(element.tag).rpartition("}")[2]
    if root.tag != "robot":
        raise FileError(path, f"is not a URDF: its root element is {root.tag}, not robot")


def _of_xacro(element: ElementTree.Element) -> str:
    """Return the name of an element of xacro; empty if it is another one."""
    space, _, name = str(element.tag).rpartition("}")
    return name if space.rstrip("/").endswith("xacro") else ""


def _check_text(path: Path, root: ElementTree.Element) -> None:
    """Refuse duplicate names and missing moments of inertia, which yourdfpy would complete silently."""
    for kind in ("link", "joint"):
        counts = Counter(one.get("name", "") for one in root.findall(kind))
        for name, count in counts.items():
            if count > 1:
                raise FileError(path, f"defines the {kind} {name} {count} times")
    for link in root.findall("link"):
        for inertia in link.findall("inertial/inertia"):
            for moment in _MOMENTS:
                if moment not in inertia.attrib:
                    raise FileError(path, f"has a link {link.get('name')} without its moment of inertia {moment}")


def _body(path: Path, name: str, inertial: yourdfpy.urdf.Inertial, pose: Array) -> Body:
    if inertial.mass is None or inertial.inertia is None:
        raise FileError(path, f"has a link {name} with an <inertial> without mass or inertia")
    at = pose if inertial.origin is None else pose @ inertial.origin
    turn = at[:3, :3]
    return Body(float(inertial.mass), at[:3, 3], turn @ np.asarray(inertial.inertia) @ turn.T)


def _axis(path: Path, joint: yourdfpy.urdf.Joint) -> Array:
    """Return the axis of a joint as a unit vector (3,)."""
    axis = np.asarray(joint.axis, dtype=float)
    length = float(np.linalg.norm(axis))
    if axis.shape != (3,) or not 1e-9 < length < np.inf:
        raise FileError(
            path, f"has a joint {joint.name} with the axis {axis.tolist()}; three numbers, not all zero, are needed"
        )
    return axis / length
