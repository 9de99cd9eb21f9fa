"""Hints at probably wrong units in the arguments and results of `continuum simulate`."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.model import InputKind
from continuum.dynamics.parameters import Parameters

_SMALL_BEND = 3.2
"""Total bend [degrees] below which a number was probably given in radians: half a turn is 3.14."""

_LONG, _RARE = 100.0, 1.0
"""Duration of a table, and time between its rows [s], above which its times are probably in milliseconds."""


def hints(posture: Array, inputs: InputSignal, p: Parameters, times: Array) -> Iterator[str]:
    """Yield hints about the start (n_joints,) [rad], the inputs, and the simulated times (n_times,) [s]."""
    bend = float(np.abs(np.degrees(posture)).sum())
    if 0 < bend <= _SMALL_BEND:
        yield f"--release is in degrees, and {bend:.3g} in total is little: were these radians?"
    bent = beyond_contact(posture[None], p)
    if bent:
        yield f"at the start {bent}"
    most = float(inputs.values.max())
    if inputs.kind is InputKind.CABLES and most > (enough := enough_tension(p)):
        yield (
            f"tensions are in newtons, and {most:g} N is more than the {enough:.0f} N that fold this arm's stiffest "
            "joint by half a turn: were these millinewtons?"
        )
    lasts = float(times[-1] - times[0])
    if lasts >= _LONG and inputs.times.size > 1 and np.median(np.diff(inputs.times)) >= _RARE:
        yield f"t_s is in seconds, and {lasts:g} s are simulated: were these milliseconds? --duration S simulates less"


def enough_tension(p: Parameters) -> float:
    """Return a tension [N] that bends any joint's spring by half a turn and lifts the whole outstretched arm."""
    weight = float(p.gravity[0] * np.sum(p.mass) * np.sum(p.joint_spacing))
    return float((np.pi * np.max(p.stiffness) + weight) / np.min(p.hole_radius))


def beyond_contact(theta: Array, p: Parameters) -> str:
    """Describe the joint bent furthest beyond contact of its discs in ``theta`` (n_times, n_joints) [rad], or ''."""
    furthest = np.abs(theta).max(axis=0)
    excess = furthest - p.contact_angle
    joint = int(np.argmax(excess))
    if not excess[joint] > 0:
        return ""
    angle, contact = np.degrees([furthest[joint], p.contact_angle[joint]])
    return f"joint {joint + 1} is bent by {angle:.0f} degrees; its discs touch at {contact:.0f}"
