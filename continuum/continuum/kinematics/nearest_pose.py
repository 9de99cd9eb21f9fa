"""The configuration that comes nearest to a target out of reach: constrained minimisation of the distance."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.bend_limits import at_limit, limits_of, within_limits
from continuum.kinematics.ik_result import IkResult, IkStatus, Target, configuration_of
from continuum.kinematics.tip_task import TipTask


def nearest_pose(
    arm: Arm, target: Target, start: Array | None = None, tolerance: float = 1e-6, max_iterations: int = 100
) -> IkResult:
    """Local minimum of the error to the target near ``start`` (n_sections, 2) [rad], bend limits kept.

    Sequential quadratic programming (Kraft's SLSQP), which knows the curvature that Gauss-Newton leaves out; that
    curvature decides where the error does not vanish. The minimum is local: a nearer one may exist elsewhere.

    Args:
        arm: the arm.
        target: position, and direction unless it is free.
        start: where to begin; the straight arm without it.
        tolerance: largest distance [m], and largest angle [rad], that counts as solved after all.
        max_iterations: of the minimisation.
    """
    task = TipTask(arm, target)
    limits = limits_of(arm)
    unit = arm.length  # errors in arm lengths, so that the minimiser's own tolerances fit

    def cost(x: Array) -> tuple[float, Array]:
        w = x.reshape(-1, 2)
        error = task.error(w) / unit
        return 0.5 * float(error @ error), -(task.jacobian(w).T @ error) / unit

    def room(x: Array) -> Array:
        return limits**2 - np.sum(x.reshape(-1, 2) ** 2, axis=-1)

    def room_jacobian(x: Array) -> Array:
        w = x.reshape(-1, 2)
        jacobian = np.zeros((len(w), w.size))
        for i, row in enumerate(w):
            jacobian[i, 2 * i : 2 * i + 2] = -2.0 * row
        return jacobian

    found = minimize(
        cost,
        within_limits(configuration_of(arm, start), arm).reshape(-1),
        jac=True,
        method="SLSQP",
        constraints={"type": "ineq", "fun": room, "jac": room_jacobian},
        options={"maxiter": max_iterations, "ftol": 1e-15},
    )
    w = within_limits(found.x.reshape(-1, 2), arm)
    distance, angle = task.distance_and_angle(w)
    if distance <= tolerance and angle <= tolerance:
        status = IkStatus.SOLVED
    elif not found.success:
        status = IkStatus.NO_CONVERGENCE
    else:
        status = IkStatus.LIMIT_REACHED if np.any(at_limit(w, arm)) else IkStatus.UNREACHABLE
    return IkResult(w, status, int(found.nit), distance, angle)
