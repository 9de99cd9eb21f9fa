"""A planar model from a URDF: one chain of joints whose axes are parallel.

Angles of the model are those of the URDF up to a sign and a zero: a model's joints are at zero where its links lie on
one straight line, a URDF's where it was drawn. With p_i the joints' places in the URDF's zero configuration, seen along
the first joint's axis, and phi_i the direction from p_i to p_i+1 counted from that of the first link,

    theta_i = s_i q_i + (phi_i - phi_i-1),     s_i = 1 where axis i points as the first one does, else -1.
"""

from __future__ import annotations

import io
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import yourdfpy

from continuum.arrays import Array
from continuum.dynamics.input_kind import InputKind
from continuum.dynamics.model import Model
from continuum.dynamics.parameters import Parameters
from continuum.errors import FileError

_TURNING = ("revolute", "continuous")
_PARALLEL = 1e-4  # rad: what descriptions round
_SHORTEST = 1e-4  # m, of links, as in model files
_BESIDE = 0.01  # part of a link's length by which its centre of mass may lie off the line from joint to joint
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_UNREADABLE = (
    OSError,
    SyntaxError,
    RecursionError,
    KeyError,
    AttributeError,
    TypeError,
    ValueError,
    yourdfpy.urdf.URDFError,
)
"""What yourdfpy's reading of a damaged description runs into."""


@dataclass(frozen=True)
class UrdfChain:
    """A model, and how its joints are those of the description.

    Attributes:
        model: driven by joint torques.
        joints: names in the URDF from base to tip.
        signs: s_i, (n_joints,).
        zeros: angles of the model in the URDF's zero configuration, (n_joints,) [rad].
        tip: the link whose frame is the tip; none where the last link is taken to end twice as far as its centre of
            mass lies.
    """

    model: Model
    joints: tuple[str, ...]
    signs: Array
    zeros: Array
    tip: str | None


@dataclass(frozen=True)
class _Body:
    """Mass [kg], centre of mass (3,) [m] and inertia about it (3, 3) [kg m2] in the root's frame."""

    mass: float
    centre: Array
    inertia: Array


@dataclass
class _Group:
    """Links that are fixed to each other: their bodies, their frames' places (3,) [m], and joints that turn others."""

    bodies: list[_Body]
    frames: dict[str, Array]
    turning: list[tuple[yourdfpy.Joint, Array]]


def chain_from_urdf(
    path: str | Path, tip: str | None = None, gravity: Sequence[float] = (0.0, 0.0, -9.81)
) -> UrdfChain:
    """Read a serial arm that moves in one plane.

    Args:
        path: of the URDF.
        tip: name of the link whose frame is the tip; without it the last frame that is fixed to the last link.
        gravity: acceleration in the frame of the URDF's root, (3,) [m/s^2].

    Raises:
        FileError: no readable URDF, or none of a serial planar arm.
        InvalidValueError: a value that no model may have.
    """
    path = Path(path)
    joints, axes, places, groups = _Description(path).chain()
    axis = axes[0]
    if np.max(np.linalg.norm(np.cross(axes, axis), axis=1)) > _PARALLEL:
        raise FileError(path, "has joints whose axes are not parallel; an arm that bends in a plane is needed")
    bodies = [_lumped(path, joint.child, group.bodies) for joint, group in zip(joints, groups, strict=True)]
    end, tip = _end(path, tip, places[-1], groups[-1].frames, bodies[-1])
    along = np.array([_within(b - a, axis) for a, b in pairwise([*places, end])])
    lengths = np.linalg.norm(along, axis=1)
    if np.any(lengths < _SHORTEST):
        raise FileError(
            path, f"has no distance from joint {joints[int(np.argmin(lengths))].name} to the next, or to the tip"
        )
    directions = along / lengths[:, None]
    centres = np.array([_within(one.centre - place, axis) for one, place in zip(bodies, places, strict=True)])
    ahead = np.sum(centres * directions, axis=1)
    beside = np.linalg.norm(centres - ahead[:, None] * directions, axis=1)
    if np.any(beside > _BESIDE * lengths):
        worst = int(np.argmax(beside / lengths))
        raise FileError(
            path,
            f"has a link whose centre of mass lies {1e3 * beside[worst]:.3g} mm beside the line from joint "
            f"{joints[worst].name} to the next, or to the tip; models have theirs on it, here within "
            f"{1e3 * _BESIDE * lengths[worst]:.3g} mm",
        )
    pull = _within(np.asarray(gravity, dtype=float), axis)
    weight = float(np.linalg.norm(pull))
    turned = np.array([_angle(directions[0], one, axis) for one in directions])
    zeros = np.diff(turned, prepend=0.0)
    model = Model(
        Parameters(
            mass=np.array([one.mass for one in bodies]),
            inertia=np.array([axis @ one.inertia @ axis for one in bodies]),
            center_of_mass=ahead,
            link_length=lengths,
            viscous_friction=np.array([_dynamics(path, joint, "damping") for joint in joints]),
            coulomb_friction=np.array([_dynamics(path, joint, "friction") for joint in joints]),
            gravity=np.array([weight]),
            hang_angle=np.array([_angle(pull, directions[0], axis) if weight > 0 else 0.0]),
        ),
        inputs=InputKind.JOINT_TORQUES,
    )
    names = tuple(joint.name for joint in joints)
    return UrdfChain(model, names, np.sign(axes @ axis), (zeros + np.pi) % (2 * np.pi) - np.pi, tip)


class _Description:
    """Links and joints of a file.

    Args:
        path: of the URDF.

    Raises:
        FileError: it cannot be read, or its links are no tree.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            data = path.read_bytes()
            _check_text(path, data)
            robot = yourdfpy.URDF.load(
                io.BytesIO(data), build_scene_graph=False, load_meshes=False, build_collision_scene_graph=False
            ).robot
        except _UNREADABLE as error:
            raise FileError(path, f"cannot be read as a URDF ({type(error).__name__}: {error})") from error
        self._links = {link.name: link for link in robot.links}
        self._beyond: dict[str, list[yourdfpy.urdf.Joint]] = {name: [] for name in self._links}
        for joint in robot.joints:
            if joint.parent not in self._links or joint.child not in self._links:
                raise FileError(path, f"has a joint {joint.name} between links that it does not have")
            self._beyond[joint.parent].append(joint)
        moved = [joint.child for joint in robot.joints]
        roots = sorted(self._links.keys() - set(moved))
        if len(roots) != 1 or len(set(moved)) != len(moved):
            raise FileError(path, f"is no tree of links: its roots are {', '.join(roots) or 'none'}")
        self._root = roots[0]

    def chain(self) -> tuple[list[yourdfpy.urdf.Joint], Array, list[Array], list[_Group]]:
        """Joints from the base to the tip, their axes (n, 3), their places (3,) [m], and what each moves."""
        joints, axes, places, groups = list[yourdfpy.urdf.Joint](), list[Array](), list[Array](), list[_Group]()
        group = self._fixed_to(self._root, np.eye(4))
        while group.turning:
            if len(group.turning) > 1:
                names = ", ".join(joint.name for joint, _ in group.turning)
                raise FileError(self._path, f"branches into the joints {names}; one chain is needed")
            joint, pose = group.turning[0]
            group = self._fixed_to(joint.child, pose)
            joints.append(joint)
            axes.append(pose[:3, :3] @ _axis(self._path, joint))
            places.append(pose[:3, 3])
            groups.append(group)
        if not joints:
            raise FileError(self._path, f"has no joint that turns ({' or '.join(_TURNING)})")
        return joints, np.array(axes), places, groups

    def _fixed_to(self, name: str, pose: Array) -> _Group:
        """A link at a pose (4, 4) [m], with all that is fixed to it."""
        group, waiting = _Group([], {}, []), [(name, pose)]
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
                    kind = "moved by another one (mimic)" if joint.mimic is not None else joint.type
                    allowed = ", ".join((*_TURNING, "fixed"))
                    raise FileError(self._path, f"has the joint {joint.name}, which is {kind}; allowed: {allowed}")
        return group


def _check_text(path: Path, data: bytes) -> None:
    """Refuse what yourdfpy mends or fills in without a word: damaged text, entities, names and moments of inertia.

    Raises:
        FileError: it is damaged so.
        ParseError: it is no XML.
    """
    if b"<!DOCTYPE" in data:
        raise FileError(path, "has a document type; descriptions have none")
    root = ElementTree.fromstring(data)
    for kind in ("link", "joint"):
        counts = Counter(one.get("name", "") for one in root.findall(kind))
        for name, count in counts.items():
            if count > 1:
                raise FileError(path, f"has {count} times the {kind} {name}")
    for link in root.findall("link"):
        for inertia in link.findall("inertial/inertia"):
            for moment in _MOMENTS:
                if moment not in inertia.attrib:
                    raise FileError(path, f"has a link {link.get('name')} without its moment of inertia {moment}")


def _body(path: Path, name: str, inertial: yourdfpy.urdf.Inertial, pose: Array) -> _Body:
    if inertial.mass is None or inertial.inertia is None:
        raise FileError(path, f"has a link {name} with an <inertial> without mass or inertia")
    at = pose if inertial.origin is None else pose @ inertial.origin
    turn = at[:3, :3]
    return _Body(float(inertial.mass), at[:3, 3], turn @ np.asarray(inertial.inertia) @ turn.T)


def _axis(path: Path, joint: yourdfpy.urdf.Joint) -> Array:
    """Unit vector (3,)."""
    axis = np.asarray(joint.axis, dtype=float)
    length = float(np.linalg.norm(axis))
    if axis.shape != (3,) or not 1e-9 < length < np.inf:
        raise FileError(
            path, f"has a joint {joint.name} with the axis {axis.tolist()}; three numbers, not all zero, are needed"
        )
    return axis / length


def _lumped(path: Path, name: str, bodies: Sequence[_Body]) -> _Body:
    """Bodies as one, by the parallel axes of each."""
    mass = sum(one.mass for one in bodies)
    if not 0 < mass < np.inf:
        raise FileError(path, f"has a link {name} of mass {mass:g}; every link of a model has one, which is finite")
    centre = np.sum([one.mass * one.centre for one in bodies], axis=0) / mass
    inertia = np.zeros((3, 3))
    for one in bodies:
        away = one.centre - centre
        inertia += one.inertia + one.mass * (away @ away * np.eye(3) - np.outer(away, away))
    return _Body(mass, centre, inertia)


def _end(
    path: Path, tip: str | None, last: Array, frames: Mapping[str, Array], body: _Body
) -> tuple[Array, str | None]:
    """Place of the tip (3,) [m], and the link whose frame it is."""
    if tip is not None and tip not in frames:
        raise FileError(path, f"has no link {tip} beyond its last joint; it has {', '.join(frames)}")
    farther = [name for name, place in frames.items() if np.linalg.norm(place - last) > _SHORTEST]
    tip = tip if tip is not None or not farther else farther[-1]
    return (2 * body.centre - last, None) if tip is None else (frames[tip], tip)


def _dynamics(path: Path, joint: yourdfpy.urdf.Joint, name: str) -> float:
    given = None if joint.dynamics is None else getattr(joint.dynamics, name)
    try:
        return 0.0 if given is None else float(given)
    except ValueError as error:
        raise FileError(path, f"has a joint {joint.name} with the {name} {given!r}; a number is needed") from error


def _within(vector: Array, axis: Array) -> Array:
    """The part of a vector (3,) in the plane that is normal to an axis (3,)."""
    return vector - (vector @ axis) * axis


def _angle(start: Array, end: Array, axis: Array) -> float:
    """From one direction in the plane to another, positive about the axis [rad]."""
    return float(np.arctan2(axis @ np.cross(start, end), start @ end))
