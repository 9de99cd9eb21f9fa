"""A motion as a CSV table: the data of a recording that the page shows, readable by other programs and `continuum`."""

from __future__ import annotations

import csv
import io

import numpy as np

from continuum.arm import Arm
from continuum.viewer.description import arm_description
from continuum.viewer.link_poses import LinkPoses
from continuum.viewer.tracks import Track

_DIGITS = 9


def motion_csv(joints: Track, lengths: Track, tensions: Track, arm: Arm) -> str:
    """Return a table of time, joint angles [deg], tip [m], lengths [m] and tensions [N] at each joint state.

    The joints of an arm of one section are named as in recordings (`q1_deg`), so that the table is a recording.

    Args:
        joints: joint angles [rad].
        lengths: lengths of cables [m].
        tensions: tensions of cables [N]; a cable without lengths or tensions has no such column.
        arm: arm.
    """
    chain = LinkPoses(arm_description(arm))
    tip = chain.links.index(arm.sections[-1].tip_frame)
    (first, *others) = arm.sections
    short = {} if others else {name: f"q{i}" for i, name in enumerate(first.theta_joints, start=1)}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    angles = [f"{short.get(name, name)}_deg" for name in joints.names]
    cables = [*(f"{name}_length_m" for name in lengths.names), *(f"{name}_tension_N" for name in tensions.names)]
    writer.writerow(["t_s", *angles, "tip_x_m", "tip_y_m", "tip_z_m", *cables])
    for t, row in zip(joints.times, joints.values, strict=True):
        place = chain.poses(chain.angles(dict(zip(joints.names, row, strict=True))))[tip, :3, 3]
        known = [track.at(t).get(name, np.nan) for track in (lengths, tensions) for name in track.names]
        numbers = [t, *np.degrees(row), *place, *known]
        writer.writerow([f"{number:.{_DIGITS}g}" if np.isfinite(number) else "" for number in numbers])
    return text.getvalue()
