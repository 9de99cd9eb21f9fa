"""Whether sensors were at rest over some seconds, reasons why not, and the times at rest in a recording."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.inertial.imu_recording import ImuRecording

SHORTEST_REST = 1.0
"""Shortest rest from which a bias or a zero is found [s]."""

_FEWEST = 20  # readings of a sensor
_SD_OF_RATE = np.radians(0.5)  # rad/s, standard deviation; sensors at rest have less than 0.1 degrees/s
_CHANGE_OF_RATE = np.radians(0.2)  # rad/s, between means of the parts
_LARGEST_BIAS = np.radians(5.0)  # rad/s
_SD_OF_FORCE = 0.2  # m/s2
_PARTS = 4
_STEP = SHORTEST_REST / 4  # between windows to test

CREEP = np.radians(0.08)
"""Largest turn from the first quarter of a rest to its last [rad], which a gyroscope would show as a bias."""

SETTLED = np.radians(0.25)
"""The same if only the posture counts."""


def unrest(recording: ImuRecording, creep: float = CREEP) -> tuple[str, ...]:
    """Describe what moved, one sentence for each sensor that did or has too few readings; empty at rest.

    ``creep`` is the turn [rad] that still counts as rest.
    """
    lasts = float(np.ptp(recording.times)) if recording.times.size else 0.0
    if lasts < SHORTEST_REST:
        return (f"only {lasts:.2g} s were recorded; at least {SHORTEST_REST:g} s are needed",)
    problems = [_of_one(recording, sensor, creep) for sensor in range(recording.n_sensors)]
    return tuple(f"sensor {sensor + 1} {why}" for sensor, why in enumerate(problems) if why)


def rests(recording: ImuRecording) -> list[tuple[float, float]]:
    """Return begin and end of every rest [s], from windows of `SHORTEST_REST`; a creeping rest is cut into several."""
    found: list[tuple[float, float]] = []
    window = SHORTEST_REST + 2 * float(np.median(np.diff(recording.times)))
    for start in map(float, np.arange(recording.times[0], recording.times[-1] - window, _STEP)):
        end = start + window
        if unrest(recording.part(start, end)):
            continue
        if found and start < found[-1][1]:
            if not unrest(recording.part(found[-1][0], end)):
                found[-1] = (found[-1][0], end)
        else:
            found.append((start, end))
    return found


def _of_one(recording: ImuRecording, sensor: int, creep: float) -> str:
    good = recording.good[:, sensor]
    if np.count_nonzero(good) < max(_FEWEST, good.size // 2):
        return f"has only {np.count_nonzero(good)} good readings of {good.size}"
    rates, forces = recording.rates[good, sensor], recording.forces[good, sensor]
    means = np.array([part.mean(axis=0) for part in np.array_split(rates, _PARTS)])
    if np.linalg.norm(rates.mean(axis=0)) > _LARGEST_BIAS:
        return f"turns at {np.degrees(np.linalg.norm(rates.mean(axis=0))):.1f} degrees/s"
    if rates.std(axis=0).max() > _SD_OF_RATE or np.ptp(means, axis=0).max() > _CHANGE_OF_RATE:
        return f"swings: its rate changes by {np.degrees(np.ptp(rates, axis=0).max()):.1f} degrees/s"
    if forces.std(axis=0).max() > _SD_OF_FORCE:
        return f"shakes: its acceleration has a standard deviation of {forces.std(axis=0).max():.2f} m/s2"
    parts = np.array_split(forces, _PARTS)
    turn = angle_between(parts[0].mean(axis=0), parts[-1].mean(axis=0))
    return f"turns slowly, by {np.degrees(turn):.2f} degrees" if turn > creep else ""


def angle_between(a: Array, b: Array) -> float:
    """Return the angle between two vectors, (3,) each [rad]."""
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b)))
