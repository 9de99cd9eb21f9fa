"""A motion as a CSV table: the data of a recording that the page shows, readable by other programs and `continuum`."""

from __future__ import annotations

import csv
import io

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.viewer.description import arm_description
from continuum.viewer.drawn_cables import CableLengths, batches
from continuum.viewer.link_poses import LinkPoses
from continuum.viewer.tracks import Track

_DIGITS = 9


def motion_csv(joints: Track, lengths: Track, tensions: Track, arm: Arm) -> str:
    """Return a table of time, joint angles [deg], tip [m], lengths [m] and tensions [N] at each joint state.

    The joints of an arm of one section are named as in recordings (`q1_deg`), so that the table is a recording.

    Args:
        joints: joint angles [rad].
        lengths: measured lengths of cables [m]; if empty, the lengths follow from the joint angles.
        tensions: tensions of cables [N]; a cable without tensions has no such column.
        arm: arm.
    """
    chain = LinkPoses(arm_description(arm))
    tip, cables = chain.links.index(arm.sections[-1].tip_frame), CableLengths(arm, chain.links)
    computed = lengths.times.size == 0
    tips, drawn = [], []
    for poses in batches(chain, joints):
        tips.append(poses[:, tip, :3, 3])
        if computed:
            drawn.append(cables.at(poses))
    held = np.concatenate(drawn) if computed else _held(lengths, joints.times)
    (first, *others) = arm.sections
    short = {} if others else {name: f"q{i}" for i, name in enumerate(first.theta_joints, start=1)}
    header = [
        "t_s",
        *(f"{short.get(name, name)}_deg" for name in joints.names),
        *(f"tip_{axis}_m" for axis in "xyz"),
        *(f"{name}_length_m" for name in (arm.cable_names if computed else lengths.names)),
        *(f"{name}_tension_N" for name in tensions.names),
    ]
    columns = [joints.times, np.degrees(joints.values), np.concatenate(tips), held, _held(tensions, joints.times)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    for row in np.column_stack(columns).tolist():
        writer.writerow([f"{number:.{_DIGITS}g}" if np.isfinite(number) else "" for number in row])
    return text.getvalue()


def _held(track: Track, times: Array) -> Array:
    """Return the values of a track at the given times, (n, n_names), NaN before its first."""
    if not track.times.size:
        return np.empty((times.size, 0))
    rows = np.searchsorted(track.times, times, side="right") - 1
    values: Array = np.where(rows[:, None] < 0, np.nan, track.values[rows])
    return values
