"""The figures of a simulation: what `continuum simulate` prints as a table or as JSON."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from continuum.dynamics.pulled_posture import PulledPosture
    from continuum.dynamics.trajectory import Trajectory


def figures(
    motion: Trajectory, held: PulledPosture | None, loading_time: float, integration_time: float
) -> dict[str, Any]:
    """Return all figures in SI units; those of an incomplete motion are None.

    Args:
        motion: the simulated motion.
        held: the posture that a cable held before the motion, if any.
        loading_time: time to load the equations [s].
        integration_time: time of the integration [s].
    """
    found: dict[str, Any] = {
        "status": motion.status.name,
        "duration": float(motion.times[-1] - motion.times[0]),
        "samples": int(motion.times.size),
        "integration_time": integration_time,
        "loading_time": loading_time,
        "held_tension": None if held is None else float(held.tension.max()),
        "held_angles": None if held is None else held.theta.tolist(),
    }
    names = ("bend_first", "bend_last", "bend_least", "bend_greatest", "fastest_joint", "fastest_rate", "fastest_time")
    if not np.all(np.isfinite(motion.states)):
        return found | dict.fromkeys(names)
    bend, speed = motion.theta.sum(axis=1), np.abs(motion.theta_rate)
    when, joint = np.unravel_index(int(np.argmax(speed)), speed.shape)
    bends = [float(one) for one in (bend[0], bend[-1], bend.min(), bend.max())]
    fastest = [int(joint) + 1, float(speed.max()), float(motion.times[when])]
    return found | dict(zip(names, [*bends, *fastest], strict=True))


def in_words(found: dict[str, Any], status: str) -> list[tuple[str, str]]:
    """Return the figures for a table, with angles in degrees; ``status`` describes how the integration ended."""
    pairs = []
    if found["held_tension"] is not None:
        angles = ", ".join(f"{math.degrees(angle):.2f}" for angle in found["held_angles"])
        pairs += [("held by", f"{found['held_tension']:.2f} N"), ("joint angles", f"{angles} degrees")]
    integrating = f"{found['integration_time']:.3g} s for the integration"
    pairs += [
        ("integration", status),
        ("simulated", f"{found['duration']:g} s, {found['samples']} samples"),
        ("time taken", f"{integrating}, {found['loading_time']:.2f} s before it to load the equations"),
    ]
    if found["bend_first"] is not None:
        first, last, least, greatest = (
            f"{math.degrees(found[f'bend_{one}']):.2f}" for one in ("first", "last", "least", "greatest")
        )
        speed = f"{math.degrees(found['fastest_rate']):.0f} degrees/s at {found['fastest_time']:.3f} s"
        pairs += [
            ("bend in total", f"{first} degrees at first, {last} at last, between {least} and {greatest}"),
            ("fastest joint", f"joint {found['fastest_joint']}, {speed}"),
        ]
    return pairs
