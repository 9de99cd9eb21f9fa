"""Messages of one arm in the order of their stamps, if these are from one run of one clock."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.joint_names import cable_names, theta_joints
from continuum.languages import Message
from continuum.printable import printable
from continuum.recordings.bag import stamp_ns

_SHOWN = 5  # names of other publishers' joints to list
_DENSE = 1.5  # times the messages that one run has in the same time: two runs, or a clock set back, have twice
_DAY = 86400 * 10**9  # ns: if other stamps are later, as counted from 1970, a stamp of 0 is missing
_TO_AND_FRO, _JUMP, _OFTEN = 4.0, np.deg2rad(1.0), 0.05  # multiple of the remaining change, rad, share of messages
_MOST = 1e3  # rad; larger values are damaged
_MARKS = (theta_joints("", 1)[0].removesuffix("1"), cable_names("", 1)[0].removesuffix("1"))


def of_an_arm(
    path: Path, topic: str, messages: Iterable[Any], names: Collection[str] = ()
) -> tuple[list[Any], tuple[str, ...]]:
    """Return messages with bending joints or cables in the order of their stamps, and notes on those left out.

    If there are none, or if other publishers use some of the arm's names, all messages are kept.

    Args:
        path: path of the recording.
        topic: topic of the messages.
        messages: messages with names, in the order of their arrival.
        names: the arm's names; if empty, names of a section's bending joints and cables.

    Raises:
        FileError: no message has a stamp, stamps are from two runs or from a clock that was set back, or two nodes
            publish one arm.
    """
    stamped, unstamped = _with_stamp(path, topic, list(messages))

    def is_mine(one: Any) -> bool:
        return any(name in names if names else any(mark in name for mark in _MARKS) for name in one.name)

    mine, others = [one for one in stamped if is_mine(one)], [one for one in stamped if not is_mine(one)]
    strangers = {name for one in others for name in one.name}
    if not mine or set(mine[0].name) & strangers:
        mine, others = stamped, []
    ordered = _in_order(path, topic, mine)
    if names or any(_MARKS[0] in name for one in ordered[:1] for name in one.name):
        _refuse_two_arms(path, topic, ordered)
    if not others:
        return ordered, unstamped
    text = (
        Message("{count} message of other publishers on {topic} ({names}), left out")
        if len(others) == 1
        else Message("{count} messages of other publishers on {topic} ({names}), left out")
    )
    names = printable(", ".join(sorted(strangers)[:_SHOWN])) or Message("without names")
    return ordered, (*unstamped, Message(text, count=len(others), topic=topic, names=names))


def _with_stamp(path: Path, topic: str, messages: list[Any]) -> tuple[list[Any], tuple[str, ...]]:
    """Return the messages with a valid stamp, and a note on the others; a simulated clock may begin at 0."""
    found = [one for one in messages if stamp_ns(one) != 0]
    if not found and len(messages) > 1:
        raise FileError(path, f"has no message on {topic} with a stamp; the time of measurement is not known")
    if len(found) == len(messages) or min(map(stamp_ns, found), default=0) < _DAY:
        return messages, ()
    count = len(messages) - len(found)
    text = (
        Message("{count} message without a stamp on {topic}, left out")
        if count == 1
        else Message("{count} messages without a stamp on {topic}, left out")
    )
    return found, (Message(text, count=count, topic=topic),)


def _refuse_two_arms(path: Path, topic: str, joints: Sequence[Any]) -> None:
    """Refuse joints that jump back and forth between messages: two nodes publish them, say an arm and a simulation.

    Angles a turn apart are one.
    """
    if len({tuple(one.name) for one in joints}) != 1 or len({len(one.position) for one in joints}) != 1:
        return
    angles = np.array([one.position for one in joints], dtype=float)
    if len(angles) < 3 or not angles.size:
        return
    angles = np.clip(np.nan_to_num(angles), -_MOST, _MOST)
    sizes, left = (np.max(np.abs(_within_half_a_turn(angles[k:] - angles[:-k])), axis=1) for k in (1, 2))
    jumps = np.minimum(sizes[:-1], sizes[1:]) > np.maximum(_TO_AND_FRO * left, _JUMP)
    if np.count_nonzero(jumps) > max(2, _OFTEN * len(angles)):
        at = int(np.argmax(jumps)) + 2
        raise FileError(
            path,
            f"message {at} on {topic}: joint angles jump back and forth, as in {np.count_nonzero(jumps)} of "
            f"{len(angles)} messages: do two nodes publish them?",
        )


def _within_half_a_turn(angles: Array) -> Array:
    return np.asarray((angles + np.pi) % (2 * np.pi) - np.pi)


def _in_order(path: Path, topic: str, arrived: list[Any]) -> list[Any]:
    """Return messages in the order of their stamps; a network may deliver a few in another order.

    Raises:
        FileError: stamps run backward over a time that has messages already: two runs, or a clock that was set back.
    """
    stamps = np.array([stamp_ns(one) for one in arrived], dtype=np.int64)
    steps, ordered = np.diff(stamps), np.sort(stamps)
    usual = float(np.median(steps[steps > 0])) if np.any(steps > 0) else np.inf
    begin = np.maximum(np.minimum.accumulate(stamps)[:-1], np.minimum.accumulate(stamps[::-1])[::-1][1:])
    end = np.minimum(np.maximum.accumulate(stamps)[:-1], np.maximum.accumulate(stamps[::-1])[::-1][1:])
    there = np.searchsorted(ordered, end, "right") - np.searchsorted(ordered, begin)
    twice = (there > _DENSE * (1 + (end - begin) / usual)) & (there > 2)
    for at in np.flatnonzero((steps < 0) & (twice | (usual == np.inf)))[:1] + 1:
        back = -steps[at - 1] * 1e-9
        raise FileError(
            path,
            f"message {at + 1} on {topic}: stamps run backward by {back:.3g} s; are these two recordings, or was "
            "the clock set back?",
        )
    return [arrived[k] for k in np.argsort(stamps, kind="stable")]
