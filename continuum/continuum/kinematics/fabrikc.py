"""FABRIKc: heuristic inverse kinematics of constant-curvature sections (Zhang et al. 2018, after FABRIK).

Two straight legs of equal length, tangent to the section at its base and at its tip, replace every bent section; they
meet in a virtual joint. Alternating passes, backward from the target and forward from the base, place every virtual
joint on the line to its neighbour until the tip stays at the target. This implementation derives the leg from the
section's polygon of rigid links, leg = chord / (2 cos(theta / 2)), so the answer is exact for inextensible sections.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import BEND_LIMIT, ArmArrays, arm_table, arrays_of
from continuum.kinematics.compiled.equations import compiled, entry_point, merged
from continuum.kinematics.compiled.limits import pull_within
from continuum.kinematics.compiled.task import FAR, TargetArrays, distance_to, miss, radian_in_metres, target_of
from continuum.kinematics.ik_result import IkResult, IkStatus
from continuum.kinematics.ik_settings import checked_arm, checked_count, checked_tolerance
from continuum.kinematics.ik_target import POSITION, Target, configuration_of
from continuum.kinematics.rigid import IDENTITY, product, turned_about_z
from continuum.kinematics.section import chord_length, configuration_entries, rotation_entries

LARGEST_BEND = 0.97 * math.pi  # towards 180 degrees the legs grow without bound


def solve_fabrikc(
    arm: Arm,
    position: Array,
    direction: Array | None = None,
    start: Array | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 100,
) -> IkResult:
    """Find a configuration with the tip at ``position`` (3,) [m] and its z axis along ``direction`` (3,) if given.

    Args:
        arm: the arm.
        position: target of the tip in ``base_link`` [m].
        direction: target direction of the tip's z axis; None leaves it free.
        start: configuration (n_sections, 2) [rad] to start from; None starts from the straight arm.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved.
        max_iterations: largest number of pairs of a backward and a forward pass.

    Raises:
        InvalidValueError: the target or the start is malformed. An unreachable target is not an error; the result's
            status reports it.
    """
    target, tolerance = Target(position, direction), checked_tolerance(tolerance)
    w = configuration_of(checked_arm(arm), start).reshape(-1)
    iterations, distance, angle = _fabrikc(
        arm_table(arm),
        radian_in_metres(arm),
        target.rows[0],
        w,
        tolerance,
        checked_count("max_iterations", max_iterations),
    )
    solved = distance <= tolerance and angle <= tolerance
    status = IkStatus.SOLVED if solved else IkStatus.NO_CONVERGENCE
    return IkResult(w.reshape(-1, 2), status, iterations, distance, angle)


@compiled
def fabrikc(
    arm: ArmArrays, target: TargetArrays, w: Array, tolerance: float, max_iterations: int
) -> tuple[int, float, float]:
    """Iterate from ``w`` (2 n_sections,) [rad] and overwrite it with the best configuration found.

    Returns:
        Iterations, distance [m] and angle [rad] of that configuration.
    """
    error = np.empty(target.n_rows)
    bases, tips = np.empty((len(arm.b) + 1, 9)), np.empty((len(arm.b), 3))
    pull_within(arm, w)
    distance, angle = miss(arm, target, w, error, bases, tips)
    tangents = bases[1:, 2::3].copy()  # third columns: a section's base has the z axis of the tip before it
    joints = np.empty_like(tangents)
    _place_joints(arm, tangents, joints)
    trial = w.copy()
    for iteration in range(max_iterations):
        if distance <= tolerance and angle <= tolerance:
            return iteration, distance, angle
        _backward(arm, target, joints, tangents)
        _forward(arm, target, joints, tangents)
        configuration_from_tangents(arm, tangents, trial)
        trial_distance, trial_angle = miss(arm, target, trial, error, bases, tips)
        if trial_distance + target.weight * trial_angle < distance + target.weight * angle:
            w[:] = trial
            distance, angle = trial_distance, trial_angle
    return max_iterations, distance, angle


@compiled
def leg_length(theta: float, b: float, n_joints: int) -> float:
    """Length [m] of a section's two virtual legs at bend ``theta`` [rad], below 180 degrees; ``b`` [m]."""
    return chord_length(theta, b, n_joints) / (2.0 * math.cos(0.5 * theta))


@merged
def _backward(arm: ArmArrays, target: TargetArrays, joints: Array, tangents: Array) -> None:
    """Move the virtual joints (n_sections, 3) [m], from the target to the base, so that they end at the target."""
    end = target.position.copy()
    tangent = tangents[-1].copy() if target.n_rows == POSITION else target.rotation[:, 2].copy()
    bends = _bends(tangents)
    for i in range(len(joints) - 1, -1, -1):
        joint = end - leg_length(bends[i], arm.b[i], arm.n_joints[i]) * tangent
        towards = _base_axis() if i == 0 else _unit(joint - joints[i - 1], _base_axis())
        base_tangent, theta = _bend_within(towards, tangent, arm.bend_limit[i])
        leg = leg_length(theta, arm.b[i], arm.n_joints[i])
        joints[i] = end - leg * tangent
        end, tangent = joints[i] - leg * base_tangent, base_tangent


@merged
def _forward(arm: ArmArrays, target: TargetArrays, joints: Array, tangents: Array) -> None:
    """Move virtual joints and tip tangents, each (n_sections, 3), from the base to the tip, to an arm on its base."""
    bends = _bends(tangents)
    base, tangent = np.zeros(3), _base_axis()
    for i in range(len(joints)):
        joint = base + leg_length(bends[i], arm.b[i], arm.n_joints[i]) * tangent
        goal = target.position if i == len(joints) - 1 else joints[i + 1]
        tip_tangent, theta = _bend_within(_unit(goal - joint, tangents[i]), tangent, arm.bend_limit[i])
        leg = leg_length(theta, arm.b[i], arm.n_joints[i])
        joints[i] = base + leg * tangent
        tangents[i] = tip_tangent
        base, tangent = joints[i] + leg * tip_tangent, tip_tangent


@merged
def _place_joints(arm: ArmArrays, tangents: Array, joints: Array) -> None:
    """Fill ``joints`` (n_sections, 3) [m] with the virtual joints of the arm with tip tangents (n_sections, 3)."""
    bends = _bends(tangents)
    base, tangent = np.zeros(3), _base_axis()
    for i in range(len(joints)):
        leg = leg_length(bends[i], arm.b[i], arm.n_joints[i])
        joints[i] = base + leg * tangent
        base, tangent = joints[i] + leg * tangents[i], tangents[i]


@compiled
def _bends(tangents: Array) -> Array:
    """Return every section's bend [rad], at most `LARGEST_BEND`, from the tip tangents (n_sections, 3)."""
    bends = np.empty(len(tangents))
    before = _base_axis()
    for i in range(len(tangents)):
        bends[i] = min(_angle(before, tangents[i]), LARGEST_BEND)
        before = tangents[i]
    return bends


@compiled
def _bend_within(free: Array, fixed: Array, bend_limit: float) -> tuple[Array, float]:
    """Return the unit vector ``free``, rotated towards ``fixed`` if the bend exceeds its limit, and the bend [rad]."""
    limit = min(bend_limit, LARGEST_BEND)
    theta = _angle(fixed, free)
    if theta <= limit:
        return free, theta
    across = _unit(free - np.sum(free * fixed) * fixed, _perpendicular(fixed))
    return math.cos(limit) * fixed + math.sin(limit) * across, limit


@compiled
def configuration_from_tangents(arm: ArmArrays, tangents: Array, w: Array) -> None:
    """Fill ``w`` (2 n_sections,) [rad] with the configuration of the arm with tip tangents (n_sections, 3)."""
    rotation = IDENTITY
    for i in range(len(arm.b)):
        r = turned_about_z(rotation, arm.cos_twist[i], arm.sin_twist[i])
        t = tangents[i]
        u, v = configuration_entries(
            r[0] * t[0] + r[3] * t[1] + r[6] * t[2],
            r[1] * t[0] + r[4] * t[1] + r[7] * t[2],
            r[2] * t[0] + r[5] * t[1] + r[8] * t[2],
        )
        w[2 * i], w[2 * i + 1] = 0.5 * u, 0.5 * v  # the line to a tip makes half the angle of the tip's tangent
        rotation = product(r, rotation_entries(w[2 * i], w[2 * i + 1]))


@compiled
def _angle(a: Array, b: Array) -> float:
    return math.atan2(_length(np.cross(a, b)), np.sum(a * b))


@compiled
def _unit(vector: Array, otherwise: Array) -> Array:
    length = _length(vector)
    return vector / length if length > 1e-12 else otherwise


@compiled
def _length(vector: Array) -> float:
    return math.sqrt(np.sum(vector * vector))


@compiled
def _perpendicular(vector: Array) -> Array:
    helper = np.zeros(3)
    helper[np.argmin(np.abs(vector))] = 1.0
    return _unit(np.cross(vector, helper), helper)


@compiled
def _base_axis() -> Array:
    return np.array([0.0, 0.0, 1.0])


@entry_point
def _fabrikc(table: Array, weight: float, row: Array, w: Array, tolerance: float, max_iterations: int) -> Any:
    arm, target = arrays_of(table, table[BEND_LIMIT]), target_of(row, weight)
    iterations, distance, angle = fabrikc(arm, target, w, tolerance, max_iterations)
    if distance > 0.5 * FAR * weight:
        distance = distance_to(arm, w, row)
    return iterations, distance, angle
