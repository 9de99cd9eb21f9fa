"""Joint states of an arm whose sections are published by a node each: one message of all joints for each stamp."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from continuum.errors import FileError
from continuum.joint_names import bending_joints
from continuum.recordings.bag import stamp_ns

_MOST_ALONE = 0.5  # part of a section's messages that may have a stamp which others lack: beyond, stamps are unrelated


def joined_sections(path: Path, topic: str, messages: Sequence[Any]) -> tuple[list[Any], tuple[str, ...]]:
    """Positions of all sections by their common stamps, in the order in which these were complete, and notes.

    Messages of who publishes other joints stay as they are; so do all where fewer than two nodes publish sections, or
    where two publish the same one.

    Args:
        path: of the recording.
        topic: of the messages.
        messages: with names, in the order of their arrival.

    Raises:
        FileError: sections have hardly a stamp in common.
    """
    parts = {tuple(one.name): bending_joints(one.name).keys() for one in messages}
    parts = {names: sections for names, sections in parts.items() if sections}
    sections = [section for those in parts.values() for section in those]
    if len(parts) < 2 or len(set(sections)) < len(sections):
        return list(messages), ()
    names, counts = [name for part in parts for name in part], dict.fromkeys(parts, 0)
    joined, waiting = list[Any](), dict[int, dict[tuple[str, ...], Any]]()
    complete = 0
    for one in messages:
        part = tuple(one.name)
        if part not in parts:
            joined.append(one)
            continue
        counts[part] += 1
        there = waiting.setdefault(stamp_ns(one), {})
        there.setdefault(part, one)
        if len(there) == len(parts):
            position = np.concatenate([np.asarray(there.pop(each).position, dtype=float) for each in parts])
            nothing = np.zeros(0)
            joined.append(
                SimpleNamespace(header=one.header, name=names, position=position, velocity=nothing, effort=nothing)
            )
            complete += 1
    alone = sum(counts.values()) - complete * len(parts)
    if complete < (1 - _MOST_ALONE) * max(counts.values()):
        raise FileError(
            path,
            f"has {max(counts.values())} messages of one section on {topic}, {complete} of which have a stamp that "
            f"all {len(parts)} have: do the sections' nodes follow one command?",
        )
    left = (
        f"{alone} message{'' if alone == 1 else 's'} of single sections on {topic}, left out: others lack their stamp"
    )
    return joined, (left,) * bool(alone)
