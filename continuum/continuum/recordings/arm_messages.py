"""Messages of one arm, in the order of their stamps, where these are of one run of one clock."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from continuum.errors import FileError
from continuum.joint_names import theta_joints
from continuum.printable import printable
from continuum.recordings.bag import stamp_ns

_SHOWN = 5  # names of others
_DENSE = 1.5  # times as many messages as one run has in such a time: two runs, or a clock that was set back, have twice


def of_an_arm(messages: Sequence[Any], topic: str) -> tuple[Sequence[Any], tuple[str, ...]]:
    """Messages of who publishes bending joints, all where nobody does, and a note on those of others."""
    mark = theta_joints("", 1)[0].removesuffix("1")
    mine = [one for one in messages if any(mark in name for name in one.name)]
    others = [one for one in messages if not any(mark in name for name in one.name)]
    if not mine or not others or set(mine[0].name) & {name for one in others for name in one.name}:
        return messages, ()
    names = printable(", ".join(sorted({name for one in others for name in one.name})[:_SHOWN]))
    count = "1 message" if len(others) == 1 else f"{len(others)} messages"
    return mine, (f"{count} of others on {topic} ({names}), left out",)


def in_order(path: Path, topic: str, messages: Iterable[Any]) -> list[Any]:
    """Messages by their stamps; a network may deliver a few in another order.

    Raises:
        FileError: stamps run backward over a time that is there already: two runs, or a clock that was set back.
    """
    arrived = list(messages)
    stamps = np.array([stamp_ns(one) for one in arrived], dtype=np.int64)
    steps, ordered = np.diff(stamps), np.sort(stamps)
    late, newest = np.flatnonzero(steps < 0) + 1, np.maximum.accumulate(stamps)
    usual = float(np.median(steps[steps > 0])) if np.any(steps > 0) else np.inf
    there = np.searchsorted(ordered, newest[late - 1], "right") - np.searchsorted(ordered, stamps[late])
    dense = (there > _DENSE * (1 + (newest[late - 1] - stamps[late]) / usual)) & (there > 2)
    for at in late[dense | (usual == np.inf)][:1]:
        back = -steps[at - 1] * 1e-9
        raise FileError(
            path,
            f"message {at + 1} on {topic}: stamps run backward by {back:.3g} s; are these two recordings, or was "
            "the clock set back?",
        )
    return [arrived[k] for k in np.argsort(stamps, kind="stable")]
