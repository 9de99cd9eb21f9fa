"""Error of the tip to its target, and its Jacobian: position, position and direction, or full pose."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.equations import compiled, inlined
from continuum.kinematics.compiled.tip import fill_jacobian, nine, walk_to_tip
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION
from continuum.kinematics.rigid import Entries9

FAR = 1e7
"""Distance beyond which targets are moved nearer, in weights: a million lengths of an arm."""


class TargetArrays(NamedTuple):
    """Representation of a target in compiled code.

    Attributes:
        n_rows: POSITION, DIRECTION or POSE.
        weight: length that one radian is weighted with [m].
        position: (3,) [m].
        rotation: (3, 3); DIRECTION uses its third column only.
    """

    n_rows: int
    weight: float
    position: Array
    rotation: Array


@compiled
def target_of(row: Array, weight: float) -> TargetArrays:
    """Return the target in a row of :attr:`Targets.rows`.

    ``weight`` is the length that one radian is weighted with [m]. Rounding in the squares of very large distances would
    hide the effect of the posture. A target beyond FAR is therefore moved nearer, along its line from the base;
    `distance_to` gives the true distance.
    """
    rotation = np.zeros((3, 3))
    n_rows = POSITION
    if len(row) == 6:
        n_rows = DIRECTION
        rotation[:, 2] = row[3:]
    elif len(row) == 12:
        n_rows = POSE
        rotation[:] = row[3:].reshape(3, 3)
    position, far = row[:3], FAR * weight
    length = math.hypot(math.hypot(position[0], position[1]), position[2])
    if length > far:
        position = position / length * far
    return TargetArrays(n_rows, weight, position, rotation)


@compiled
def distance_to(arm: ArmArrays, w: Array, point: Array) -> float:
    """Return the distance [m], however large, from the tip at ``w`` (2 n_sections,) [rad] to ``point`` (>= 3,) [m]."""
    bases, tips = np.empty((len(arm.b) + 1, 9)), np.empty((len(arm.b), 3))
    _, tip = walk_to_tip(arm, w, bases, tips)
    return math.hypot(math.hypot(point[0] - tip[0], point[1] - tip[1]), point[2] - tip[2])


def radian_in_metres(arm: Arm) -> float:
    """Return the length that one radian of the tip's rotation is weighted with [m]: a tenth of the arm's length."""
    return 0.1 * arm.length


@compiled
def evaluate(arm: ArmArrays, target: TargetArrays, w: Array, error: Array, jacobian: Array) -> tuple[float, float]:
    """Return the distance [m] and the angle [rad] from the tip at ``w`` (2 n_sections,) [rad] to the target.

    Fills ``error`` (n_rows,) [m] and the first n_rows rows of ``jacobian`` (6, 2 n_sections) [m/rad]: position in
    ``base_link``, then rotation in the tip frame times the weight. The Jacobian's transpose times the error is the
    exact descent of half the squared error.
    """
    bases, tips = np.empty((len(arm.b) + 1, 9)), np.empty((len(arm.b), 3))
    distance, angle = miss(arm, target, w, error, bases, tips)
    fill_task_jacobian(arm, target, w, bases, tips, jacobian)
    return distance, angle


@inlined
def miss(
    arm: ArmArrays, target: TargetArrays, w: Array, error: Array, bases: Array, tips: Array
) -> tuple[float, float]:
    """As `evaluate` without the Jacobian; fills ``bases`` and ``tips``, from which `fill_task_jacobian` computes it."""
    rotation, position = walk_to_tip(arm, w, bases, tips)
    square = 0.0
    for k in range(3):
        error[k] = target.position[k] - position[k]
        square += error[k] * error[k]
    angle = 0.0
    if target.n_rows > POSITION:
        angle = _fill_rotation_error(target, rotation, error)
    return math.sqrt(square), angle


@inlined
def fill_task_jacobian(
    arm: ArmArrays, target: TargetArrays, w: Array, bases: Array, tips: Array, jacobian: Array
) -> None:
    """Fill ``jacobian`` (6, 2 n_sections) as `evaluate` does, from the ``bases`` and ``tips`` of `miss`."""
    fill_jacobian(arm, w, bases, tips, jacobian)
    if target.n_rows > POSITION:
        turn_into_tip_frame(nine(bases[-1]), target.n_rows, target.weight, jacobian)


@inlined
def _fill_rotation_error(target: TargetArrays, rotation: Entries9, error: Array) -> float:
    """Fill the rotation vector, in the tip frame, from the tip to the target; return its angle [rad]."""
    d = np.empty((3, 3))  # the target's axes in the tip frame
    for i in range(3):
        for j in range(3):
            d[i, j] = (
                rotation[i] * target.rotation[0, j]
                + rotation[3 + i] * target.rotation[1, j]
                + rotation[6 + i] * target.rotation[2, j]
            )
    if target.n_rows == DIRECTION:
        x, y, z = -d[1, 2], d[0, 2], 0.0
        cosine = d[2, 2]
    else:
        x, y, z = 0.5 * (d[2, 1] - d[1, 2]), 0.5 * (d[0, 2] - d[2, 0]), 0.5 * (d[1, 0] - d[0, 1])
        cosine = 0.5 * (d[0, 0] + d[1, 1] + d[2, 2] - 1.0)
    sine = math.sqrt(x * x + y * y + z * z)
    angle = math.atan2(sine, cosine)
    if sine < 1e-12:  # no rotation, or half a turn about an undetermined axis: use x
        x, y, z, sine = 1.0, 0.0, 0.0, 1.0
    scale = target.weight * angle / sine
    error[3], error[4] = scale * x, scale * y
    if target.n_rows == POSE:
        error[5] = scale * z
    return angle


@inlined
def turn_into_tip_frame(rotation: Entries9, n_rows: int, weight: float, jacobian: Array) -> None:
    """Rotate the rows 3 to n_rows of ``jacobian`` from ``base_link`` into the tip frame, and apply the weight."""
    for k in range(jacobian.shape[1]):
        x, y, z = jacobian[3, k], jacobian[4, k], jacobian[5, k]
        for i in range(n_rows - 3):
            jacobian[3 + i, k] = weight * (rotation[i] * x + rotation[3 + i] * y + rotation[6 + i] * z)


@compiled
def squared(error: Array) -> float:
    """Sum of squares."""
    total = 0.0
    for value in error:
        total += value * value
    return total
