"""Mode of each joint's friction in each interval, from the smoothed trajectory: it slips, sticks, or reverses.

The dry friction of a slipping joint has a known sign. That of a joint that sticks or reverses is whatever the motion
requires: its acceleration is given, zero or that of its rates, with small or large process noise. So no jump of a sign
is integrated, and stiction needs no torque as an explanation. Modes stay fixed while hypotheses are compared: they are
part of the likelihood.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.estimation.run import Run, Trajectory

SLIPPING = 0.3
"""Rate [rad/s] above which the direction of motion is known: Stribeck's rate of greased joints, below which friction
varies most; higher if smoothed rates are uncertain."""
_SURE = 3.0  # standard deviations of a smoothed rate above which its direction is known
_STUCK, _REVERSING = 0.05, 3.0  # rad/s by which a rate may change within a sample of 1/120 s, one standard deviation
_SAMPLE = 1 / 120  # s
_WHITE = 2e-4  # N m sqrt(s): white torque of a slipping joint, 2 mN m over a sample
_SLOW = 0.4  # rad/s: below, friction is uncertain by a part of the Stribeck torque
_MOVED = 0.5  # fraction of SLIPPING that the readings must reach too: smoothing rings where a joint stops


@dataclass(frozen=True)
class FrictionModes:
    """Modes of every interval, (n_times - 1, n) each.

    Attributes:
        sign: sign of the slip, 0 if unknown.
        rate_noise: standard deviation of the change of a given rate over the interval; 0 if the joint slips [rad/s].
        torque_noise: intensity of white torque of a slipping joint [N m sqrt(s)].
        acceleration: acceleration of a joint with unknown friction, from the rates of the trajectory [rad/s2].
    """

    sign: Array
    rate_noise: Array
    torque_noise: Array
    acceleration: Array


def friction_modes(run: Run, way: Trajectory, stribeck_torque: Array, rate_sd: Array | None = None) -> FrictionModes:
    """Return the modes along a trajectory.

    Args:
        run: run with the readings.
        way: smoothed trajectory.
        stribeck_torque: excess of friction at rest over that of fast motion, (n,) [N m].
        rate_sd: standard deviation of the smoothed rates, (n_times, n) [rad/s].
    """
    w, h = way.w, run.intervals[:, None]
    least = SLIPPING if rate_sd is None else np.maximum(SLIPPING, _SURE * rate_sd)
    moving = np.where(np.abs(w) < least, 0.0, np.sign(w))
    one_sided = _without_creep(moving)
    sign = np.where(one_sided[:-1] == one_sided[1:], one_sided[:-1], 0.0)
    sign = np.where(sign * _measured_rate(run) >= _MOVED * SLIPPING, sign, 0.0)
    stuck = (moving[:-1] == 0) & (moving[1:] == 0)
    noise = np.where(stuck, _STUCK, _REVERSING) * np.sqrt(h / _SAMPLE)
    slowest = _slowest_nearby(np.abs(w))
    creep = stribeck_torque * np.exp(-((slowest / _SLOW) ** 2)) * np.sqrt(_SAMPLE)
    slips = sign != 0
    acceleration = np.where(stuck, 0.0, np.diff(way.w, axis=0) / h)
    return FrictionModes(
        np.ascontiguousarray(sign), np.where(slips, 0.0, noise), np.where(slips, _WHITE + creep, 0.0), acceleration
    )


def _without_creep(moving: Array) -> Array:
    """Return signs of motion in which a joint that is slow for a single row keeps its sign."""
    last, following = moving.copy(), moving.copy()
    last[1:] = np.where(moving[1:] != 0, moving[1:], moving[:-1])
    following[:-1] = np.where(moving[:-1] != 0, moving[:-1], moving[1:])
    return np.where(last == following, last, 0.0)


def _measured_rate(run: Run) -> Array:
    """Return the rate in each interval from readings alone, (n_times - 1, n) [rad/s]; 0 where a row is missing."""
    n = run.n
    if run.has_rates:
        rates, live = run.readings[:, n:], run.live[:, n:]
        rate = 0.5 * (rates[:-1] + rates[1:])
    else:
        live = run.live
        rate = np.diff(run.readings, axis=0) / run.intervals[:, None]
    return np.where((live[:-1] > 0) & (live[1:] > 0), rate, 0.0)


def _slowest_nearby(speed: Array) -> Array:
    """Return the least speed at the interval's ends and one row beyond them, (n_times - 1, n)."""
    least = np.minimum(speed[:-1], speed[1:])
    least[1:] = np.minimum(least[1:], speed[:-2])
    least[:-1] = np.minimum(least[:-1], speed[2:])
    return least


def slip_rates(run: Run, way: Trajectory, modes: FrictionModes) -> Array:
    """Return the rates for dry friction in the substeps, (rows, n) [rad/s]; a slipping joint's has the known sign."""
    _, w = run.between(way)
    sign = np.repeat(modes.sign, np.diff(run.first), axis=0)
    return np.where(sign != 0, sign * np.maximum(sign * w, SLIPPING / 4), w)
