"""Joint states of an arm with one node for each section, joined: one message with all joints for each stamp."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from continuum.errors import FileError
from continuum.joint_names import bending_joints
from continuum.languages import Message
from continuum.recordings.bag import stamp_ns

_MOST_ALONE = 0.5  # fraction of a section's messages with a stamp that others lack; beyond, stamps are unrelated


def joined_sections(path: Path, topic: str, messages: Sequence[Any]) -> tuple[list[Any], tuple[str, ...]]:
    """Join the positions of all sections by common stamps, in the order of completion; return them with notes.

    Messages with other joints stay as they are; so do all messages if fewer than two nodes publish sections, or if two
    publish the same one.

    Args:
        path: path of the recording.
        topic: topic of the messages.
        messages: messages with names, in the order of their arrival.

    Raises:
        FileError: sections have hardly any stamps in common.
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
            f"all {len(parts)} sections share: do the sections' nodes follow one command?",
        )
    text = (
        Message("{count} message of single sections on {topic}, left out: others lack their stamp")
        if alone == 1
        else Message("{count} messages of single sections on {topic}, left out: others lack their stamp")
    )
    return joined, (Message(text, count=alone, topic=topic),) * bool(alone)
