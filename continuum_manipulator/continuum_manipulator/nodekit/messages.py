"""Checks of the content of messages. All raise :class:`MessageFault` and name the field."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import lru_cache

import numpy as np

from continuum.arrays import Array
from continuum.did_you_mean import did_you_mean
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.nodekit.stamps import Stamp, nanoseconds

NO_STAMP = "no stamp"
NOT_FINITE = "not finite"
WRONG_LENGTH = "wrong length"
REPEATED_NAME = "repeated name"
MISSING_NAME = "missing name"
UNKNOWN_NAME = "unknown name"
WRONG_FRAME = "wrong frame"
NO_ROTATION = "no rotation"
REFUSED = "value out of range"


def stamped(stamp: Stamp) -> None:
    """Check that the message has a stamp; without stamps, different instants are indistinguishable."""
    if nanoseconds(stamp) == 0:
        raise MessageFault(NO_STAMP, "the message has no stamp; publish it with {header: {stamp: now}, ...}")


def finite(field: str, values: Sequence[float]) -> Array:
    """Return the values as an array after checking that they are finite."""
    array = np.asarray(values, dtype=float)
    bad = ~np.isfinite(array)
    if bad.any():
        i = int(np.argmax(bad))
        raise MessageFault(NOT_FINITE, f"{field}[{i}] is {array[i]}; a finite number is needed")
    return array


def finite_vector(field: str, vector: object) -> Array:
    """Return x, y, z of a ``geometry_msgs`` point or vector as a finite array (3,)."""
    values = [getattr(vector, axis) for axis in "xyz"]
    for axis, value in zip("xyz", values, strict=True):
        if not math.isfinite(value):
            raise MessageFault(NOT_FINITE, f"{field}.{axis} is {value}; a finite number is needed")
    return np.array(values)


def z_axis(field: str, quaternion: object) -> Array:
    """Return the z axis (3,) of the frame of a ``geometry_msgs/Quaternion``, whose norm need not be exactly 1."""
    x, y, z, w = (getattr(quaternion, part) for part in "xyzw")
    norm = math.hypot(x, y, z, w)
    if not math.isfinite(norm):
        raise MessageFault(NOT_FINITE, f"{field} is ({x}, {y}, {z}, {w}); finite numbers are needed")
    if norm < 1e-6:
        raise MessageFault(NO_ROTATION, f"{field} is ({x}, {y}, {z}, {w}); its norm must not be 0")
    x, y, z, w = x / norm, y / norm, z / norm, w / norm
    return np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])


def same_length(field: str, values: Sequence[float], names: Sequence[str], optional: bool = False) -> None:
    """Check that ``values`` has one entry for every name; with ``optional`` it may also be empty (unknown)."""
    if len(values) == len(names) or (optional and len(values) == 0):
        return
    allowed = f"{len(names)}, one for every name" + (", or none" if optional else "")
    raise MessageFault(WRONG_LENGTH, f"{field} has {len(values)} entries; allowed: {allowed}")


def named(names: Sequence[str], kind: str, wanted: Sequence[str]) -> None:
    """Check that there are names; otherwise the fault lists the wanted names of that ``kind`` (cables, joints)."""
    if len(names) == 0:
        raise MessageFault(MISSING_NAME, f"name is empty; list the {kind}: {', '.join(wanted)}")


def positions_by_name(names: Sequence[str]) -> dict[str, int]:
    """Return the position of each name; no name may occur twice."""
    index = {name: i for i, name in enumerate(names)}
    if len(index) < len(names):
        twice = next(name for i, name in enumerate(names) if index[name] != i)
        raise MessageFault(REPEATED_NAME, f"{twice} appears more than once")
    return index


def indices_of(wanted: Sequence[str], names: Sequence[str]) -> list[int]:
    """Return the positions of the wanted names in ``names``, which must contain all of them."""
    index = positions_by_name(names)
    missing = [name for name in wanted if name not in index]
    if missing:
        strangers = [name for name in names if name not in wanted]
        raise MessageFault(MISSING_NAME, f"{', '.join(missing)} not in the message{misspelt(strangers, missing)}")
    return [index[name] for name in wanted]


def no_others(known: Sequence[str], names: Sequence[str]) -> None:
    """Check that all names are ``known``."""
    unknown = [name for name in names if name not in known]
    if unknown:
        hint = nearest(unknown[0], tuple(known)) or f"; known: {', '.join(known)}"
        raise MessageFault(UNKNOWN_NAME, f"{', '.join(unknown)}{hint}")


def nothing_known(kind: str, names: Sequence[str], known: Iterable[str]) -> MessageFault:
    """Return the fault of a message that names only strangers; ``kind`` says of what (joint, cable)."""
    hint = nearest(names[0], tuple(known)) if len(names) else ""
    text = f"no {kind} of this arm is in the message"
    return MessageFault(MISSING_NAME, f"{text}, which has {names[0]}{hint}" if hint else text)


def misspelt(strangers: Iterable[str], missing: Sequence[str]) -> str:
    """Return a hint at the first name among ``strangers`` that is near to a ``missing`` one; empty if there is none."""
    for name in strangers:
        if hint := nearest(name, tuple(missing)):
            return f"; it has {name}{hint}"
    return ""


@lru_cache(maxsize=1000)
def nearest(name: str, known: tuple[str, ...]) -> str:
    """As `did_you_mean`; remembered, because who misspells a name does so in every message."""
    return did_you_mean(name, known)


def frame(field: str, frame_id: str, allowed: str) -> None:
    """Check that the frame is ``allowed`` or empty."""
    if frame_id not in ("", allowed):
        raise MessageFault(WRONG_FRAME, f"{field} is {frame_id!r}; allowed: {allowed!r} or empty")
