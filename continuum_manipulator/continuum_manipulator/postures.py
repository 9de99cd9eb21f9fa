"""Checks of requested postures of a simulated arm: joint angles from base to tip."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.errors import InvalidValueError


def initial_posture(n_joints: int, values: Mapping[str, Any]) -> Array:
    """Return the posture (n_joints,) [rad] from the parameter ``initial_angles``, or else ``initial_bend``.

    Raises:
        InvalidValueError: both are given, or the posture is impossible; the message names the given parameter.
    """
    angles, bend = values["initial_angles"], values["initial_bend"]
    if angles and bend:
        raise InvalidValueError("initial_bend", bend, "0 if initial_angles are given")
    if angles:
        return checked_posture("initial_angles", angles, n_joints)
    if abs(bend) > n_joints * math.pi:
        allowed = f"up to {n_joints * math.pi:.2f} rad to either side, pi at each of {n_joints} joints"
        raise InvalidValueError("initial_bend", bend, f"{allowed}; {bend:g} degrees are {math.radians(bend):.4g} rad")
    return np.full(n_joints, bend / n_joints)


def checked_posture(name: str, angles: Sequence[float], n_joints: int) -> Array:
    """Return the angles (n_joints,) [rad], each from -pi to pi.

    Raises:
        InvalidValueError: the number of angles is wrong, or one is out of range.
    """
    posture = np.array(angles, dtype=float)
    if posture.shape != (n_joints,) or not np.all(np.abs(posture) <= math.pi):
        raise InvalidValueError(name, posture.tolist(), f"{n_joints} angles, each from -pi to pi rad")
    return posture
