"""Postures that a simulated arm is asked for: joint angles from base to tip."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError


def initial_posture(n_joints: int, values: Mapping[str, Any]) -> Array:
    """Of the parameters ``initial_angles``, or where there are none ``initial_bend``, (n_joints,) [rad].

    Raises:
        InvalidValueError: both are given, or a posture that cannot be; the one that was given is named.
    """
    angles, bend = values["initial_angles"], values["initial_bend"]
    if angles and bend:
        raise InvalidValueError("initial_bend", bend, "0, or no initial_angles beside it")
    if angles:
        return checked_posture("initial_angles", angles, n_joints)
    if abs(bend) > n_joints * math.pi:
        allowed = f"up to {n_joints * math.pi:.2f} rad to either side, pi at each of {n_joints} joints"
        raise InvalidValueError("initial_bend", bend, f"{allowed}; {bend:g} degrees are {math.radians(bend):.4g} rad")
    return np.full(n_joints, bend / n_joints)


def checked_posture(name: str, angles: Sequence[float], n_joints: int) -> Array:
    """The angles (n_joints,) [rad], each from -pi to pi.

    Raises:
        InvalidValueError: another number of them, or one that is not within.
    """
    posture = np.array(angles, dtype=float)
    if posture.shape != (n_joints,) or not np.all(np.abs(posture) <= math.pi):
        raise InvalidValueError(name, posture.tolist(), f"{n_joints} angles, each from -pi to pi rad")
    return posture
