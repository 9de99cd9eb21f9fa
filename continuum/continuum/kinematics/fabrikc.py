"""FABRIKc: heuristic inverse kinematics of constant-curvature sections (Zhang et al. 2018, after FABRIK).

Every bent section is replaced by two straight legs of equal length, tangent to the section at its base and at its tip;
they meet in a virtual joint. Going backward from the target and forward from the base in turn, every virtual joint is
put on the line to its neighbour, until the tip stays at the target. Here the leg follows the section's polygon of rigid
links, so the answer is exact for inextensible sections: leg = chord / (2 cos(theta / 2)).
"""

from __future__ import annotations

import math

import numpy as np

from continuum.arm import Arm, Section
from continuum.arrays import Array
from continuum.kinematics.bend_limits import within_limits
from continuum.kinematics.chain import section_tip_poses
from continuum.kinematics.ik_result import IkResult, IkStatus, Target, configuration_of
from continuum.kinematics.rigid import rotation_about_z
from continuum.kinematics.section import configuration_from_point, section_rotation
from continuum.kinematics.section.chord import chord_length
from continuum.kinematics.tip_task import TipTask

_LARGEST_BEND = 0.97 * math.pi  # towards 180 degrees the legs grow without bound
_BASE_AXIS = np.array([0.0, 0.0, 1.0])


def solve_fabrikc(
    arm: Arm,
    position: Array,
    direction: Array | None = None,
    start: Array | None = None,
    tolerance: float = 1e-6,
    max_iterations: int = 100,
) -> IkResult:
    """Configuration that brings the arm's tip to ``position`` (3,) [m], its z axis along ``direction`` (3,) if given.

    Args:
        arm: the arm.
        position: target of the tip in ``base_link`` [m].
        direction: where the tip's z axis shall point; None leaves it free.
        start: configuration (n_sections, 2) [rad] to start from; the straight arm without it.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved.
        max_iterations: pairs of a backward and a forward pass.

    Raises:
        InvalidValueError: malformed target or start. A hard target is no error: see the result's status.
    """
    task = TipTask(arm, Target(position, direction))
    tangents = section_tip_poses(within_limits(configuration_of(arm, start), arm), arm)[:, :3, 2]
    joints = _forward_joints(arm, tangents)
    best = _result(task, tangents, 0, tolerance)
    for iteration in range(1, max_iterations + 1):
        if best.solved:
            break
        joints = _backward(arm, task.target, joints, tangents)
        joints, tangents = _forward(arm, task.target, joints, tangents)
        result = _result(task, tangents, iteration, tolerance)
        if result.distance + task.weight * result.angle < best.distance + task.weight * best.angle:
            best = result
    return best


def leg_length(theta: float, section: Section) -> float:
    """Length [m] of a section's two virtual legs at bend ``theta`` [rad], below 180 degrees."""
    return float(chord_length(np.asarray(theta), section)) / (2 * math.cos(0.5 * theta))


def _backward(arm: Arm, target: Target, joints: Array, tangents: Array) -> Array:
    """From the target to the base: virtual joints (n_sections, 3) [m] that end at the target."""
    joints = joints.copy()
    end = target.position
    tangent = tangents[-1] if target.direction is None else target.direction
    bends = _bends(tangents)
    for i in reversed(range(arm.n_sections)):
        section = arm.sections[i]
        joint = end - leg_length(bends[i], section) * tangent
        towards = _BASE_AXIS if i == 0 else _unit(joint - joints[i - 1], _BASE_AXIS)
        base_tangent, theta = _bend_within(towards, tangent, section)
        leg = leg_length(theta, section)
        joints[i] = end - leg * tangent
        end, tangent = joints[i] - leg * base_tangent, base_tangent
    return joints


def _forward(arm: Arm, target: Target, joints: Array, tangents: Array) -> tuple[Array, Array]:
    """From the base to the tip: virtual joints and tip tangents, each (n_sections, 3), of an arm on its base."""
    joints, tangents = joints.copy(), tangents.copy()
    bends = _bends(tangents)
    base, tangent = np.zeros(3), _BASE_AXIS
    for i, section in enumerate(arm.sections):
        joint = base + leg_length(bends[i], section) * tangent
        goal = target.position if i == arm.n_sections - 1 else joints[i + 1]
        tangents[i], theta = _bend_within(_unit(goal - joint, tangents[i]), tangent, section)
        leg = leg_length(theta, section)
        joints[i] = base + leg * tangent
        base, tangent = joints[i] + leg * tangents[i], tangents[i]
    return joints, tangents


def _forward_joints(arm: Arm, tangents: Array) -> Array:
    """Virtual joints (n_sections, 3) [m] of the arm whose sections end with the tangents (n_sections, 3)."""
    joints = np.zeros((arm.n_sections, 3))
    base, tangent = np.zeros(3), _BASE_AXIS
    for i, (section, theta) in enumerate(zip(arm.sections, _bends(tangents), strict=True)):
        leg = leg_length(theta, section)
        joints[i] = base + leg * tangent
        base, tangent = joints[i] + leg * tangents[i], tangents[i]
    return joints


def _bends(tangents: Array) -> list[float]:
    """Bend of every section [rad], as far as its legs can follow, from the tip tangents (n_sections, 3)."""
    before = np.vstack([_BASE_AXIS, tangents[:-1]])
    return [min(_angle(a, b), _LARGEST_BEND) for a, b in zip(before, tangents, strict=True)]


def _bend_within(free: Array, fixed: Array, section: Section) -> tuple[Array, float]:
    """The unit vector ``free``, turned towards ``fixed`` if the section cannot bend so far, and the bend [rad]."""
    limit = min(section.bend_limit, _LARGEST_BEND)
    theta = _angle(fixed, free)
    if theta <= limit:
        return free, theta
    across = _unit(free - (free @ fixed) * fixed, _perpendicular(fixed))
    return math.cos(limit) * fixed + math.sin(limit) * across, limit


def _result(task: TipTask, tangents: Array, iterations: int, tolerance: float) -> IkResult:
    configuration = _configuration_from_tangents(task.arm, tangents)
    distance, angle = task.distance_and_angle(configuration)
    solved = distance <= tolerance and angle <= tolerance
    status = IkStatus.SOLVED if solved else IkStatus.NO_CONVERGENCE
    return IkResult(configuration, status, iterations, distance, angle)


def _configuration_from_tangents(arm: Arm, tangents: Array) -> Array:
    """Configuration (n_sections, 2) [rad] of the arm whose sections end with the tangents (n_sections, 3)."""
    rotation = np.eye(3)
    configuration = np.zeros((arm.n_sections, 2))
    for i, section in enumerate(arm.sections):
        rotation = rotation @ rotation_about_z(section.twist)
        # A tip is seen at half the angle at which it points.
        configuration[i] = 0.5 * configuration_from_point(rotation.T @ tangents[i])
        rotation = rotation @ section_rotation(configuration[i])
    return configuration


def _angle(a: Array, b: Array) -> float:
    return math.atan2(float(np.linalg.norm(np.cross(a, b))), float(a @ b))


def _unit(vector: Array, otherwise: Array) -> Array:
    length = float(np.linalg.norm(vector))
    return vector / length if length > 1e-12 else otherwise


def _perpendicular(vector: Array) -> Array:
    helper = np.eye(3)[int(np.argmin(np.abs(vector)))]
    return _unit(np.cross(vector, helper), helper)
