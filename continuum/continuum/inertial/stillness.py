"""Whether sensors were at rest over some seconds, and what tells otherwise."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.inertial.imu_recording import ImuRecording

SHORTEST_REST = 1.0
"""From which a bias or a zero is found [s]."""

_FEWEST = 20  # readings of a sensor
_SD_OF_RATE = np.radians(0.5)  # rad/s, standard deviation; sensors at rest have less than 0.1 degrees/s
_CHANGE_OF_RATE = np.radians(0.2)  # rad/s, between means of the parts
_LARGEST_BIAS = np.radians(5.0)  # rad/s
_SD_OF_FORCE = 0.2  # m/s2
_PARTS = 4

CREEP = np.radians(0.08)
"""Turn from the first quarter of a rest to its last [rad], which would look like a bias to a gyroscope."""

SETTLED = np.radians(0.25)
"""The same, where only the posture counts."""


def unrest(recording: ImuRecording, creep: float = CREEP) -> tuple[str, ...]:
    """What moved, one sentence for each sensor that did, or that says too little; empty at rest.

    ``creep`` is the turn [rad] that still counts as rest.
    """
    lasts = float(np.ptp(recording.times)) if recording.times.size else 0.0
    if lasts < SHORTEST_REST:
        return (f"only {lasts:.2g} s were recorded; at least {SHORTEST_REST:g} s are needed",)
    problems = [_of_one(recording, sensor, creep) for sensor in range(recording.n_sensors)]
    return tuple(f"sensor {sensor + 1} {why}" for sensor, why in enumerate(problems) if why)


def _of_one(recording: ImuRecording, sensor: int, creep: float) -> str:
    good = recording.good[:, sensor]
    if np.count_nonzero(good) < max(_FEWEST, good.size // 2):
        return f"was heard only {np.count_nonzero(good)} times of {good.size}"
    rates, forces = recording.rates[good, sensor], recording.forces[good, sensor]
    means = np.array([part.mean(axis=0) for part in np.array_split(rates, _PARTS)])
    if np.linalg.norm(rates.mean(axis=0)) > _LARGEST_BIAS:
        return f"turns at {np.degrees(np.linalg.norm(rates.mean(axis=0))):.1f} degrees/s"
    if rates.std(axis=0).max() > _SD_OF_RATE or np.ptp(means, axis=0).max() > _CHANGE_OF_RATE:
        return f"swings: its rate changes by {np.degrees(np.ptp(rates, axis=0).max()):.1f} degrees/s"
    if forces.std(axis=0).max() > _SD_OF_FORCE:
        return f"shakes: its acceleration spreads by {forces.std(axis=0).max():.2f} m/s2"
    parts = np.array_split(forces, _PARTS)
    turn = angle_between(parts[0].mean(axis=0), parts[-1].mean(axis=0))
    return f"turns slowly, by {np.degrees(turn):.2f} degrees" if turn > creep else ""


def angle_between(a: Array, b: Array) -> float:
    """Angle between two vectors, (3,) each [rad]."""
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b)))
