"""The streams of an arm in a recording, as arrays: trajectory, joints and cables by stamp."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import FileError
from continuum.kinematics.configuration import allen_from_jones
from continuum.recordings.bag import Bag, stamp_ns

Stamps = NDArray[np.int64]


@dataclass(frozen=True)
class Stream:
    """One topic: stamps (n,) [ns] in order of arrival and the values (n, ...) that belong to them."""

    stamps: Stamps
    values: Array

    def at(self, stamps: Stamps) -> Array:
        """Values of the given stamps (m,) [ns]; NaN where a stamp is not in the stream."""
        rows = np.full((len(stamps), *self.values.shape[1:]), np.nan)
        _, wanted, found = np.intersect1d(stamps, self.stamps, return_indices=True)
        rows[wanted] = self.values[found]
        return rows


@dataclass(frozen=True)
class ArmRecording:
    """What a kinematic run recorded.

    Attributes:
        targets: positions that the tip was to take (n, 3) [m].
        status: answers of the inverse kinematics (n, 2): status number and distance [m].
        configurations: Allen coordinates from the joint states (n, n_sections, 2) [rad].
        lengths: total cable lengths (n, n_cables) [m], in the order of ``arm.cable_names``.
        rates: rates of those (n, n_cables) [m/s].
        section_counts: messages of ``/section_cable_states`` by section.
    """

    arm: Arm
    targets: Stream
    status: Stream
    configurations: Stream
    lengths: Stream
    rates: Stream
    section_counts: tuple[int, ...]


def read_arm_recording(bag: Bag, arm: Arm) -> ArmRecording:
    """Read the streams of ``arm`` from a recording.

    Raises:
        InvalidValueError: a topic is missing.
        FileError: a message names other joints or cables than the arm has.
    """
    sections = [int(message.section) for message in bag.messages("/section_cable_states")]
    cables = list(bag.messages("/cable_states"))
    unknown = np.full(len(arm.cable_names), np.nan)
    return ArmRecording(
        arm=arm,
        targets=_stream(bag.messages("/traj_pose"), lambda m: _xyz(m.pose.position)),
        status=_stream(bag.messages("/ik_status"), lambda m: [float(m.status), m.distance]),
        configurations=_stream(bag.messages("/joint_states"), lambda m: _configuration(bag, m, arm)),
        lengths=_stream(cables, lambda m: m.position[_indices(bag, m.name, arm.cable_names)]),
        rates=_stream(
            cables, lambda m: m.velocity[_indices(bag, m.name, arm.cable_names)] if len(m.velocity) else unknown
        ),
        section_counts=tuple(sections.count(i + 1) for i in range(arm.n_sections)),
    )


def _stream(messages: Iterable[Any], value_of: Callable[[Any], ArrayLike]) -> Stream:
    messages = list(messages)
    stamps = np.array([stamp_ns(message) for message in messages], dtype=np.int64)
    return Stream(stamps, np.array([value_of(message) for message in messages], dtype=float))


def _configuration(bag: Bag, message: Any, arm: Arm) -> Array:
    """Allen coordinates (n_sections, 2) of one joint state message; theta is the sum over a section's joints."""
    names = [name for section in arm.sections for name in (section.phi_joint, *section.theta_joints)]
    angles = dict(zip(names, message.position[_indices(bag, message.name, names)], strict=True))
    return np.array(
        [
            allen_from_jones(angles[section.phi_joint], sum(angles[name] for name in section.theta_joints))
            for section in arm.sections
        ]
    )


def _indices(bag: Bag, given: list[str], wanted: list[str] | tuple[str, ...]) -> list[int]:
    missing = [name for name in wanted if name not in given]
    if missing:
        raise FileError(bag.path, f"holds no {missing[0]}; recorded with another arm? It has {list(given)}")
    return [given.index(name) for name in wanted]


def _xyz(vector: Any) -> list[float]:
    return [vector.x, vector.y, vector.z]
