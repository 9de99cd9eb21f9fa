"""The posture in which the torques of gravity, springs and cables cancel at every joint, without friction."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.simulation_input import finite_array
from continuum.dynamics.statics.resting_arm import Load, RestingArm
from continuum.errors import InvalidValueError

_SOLVED = 1e-10  # residual torque [N m], relative to the largest torque of the problem if that exceeds 1 N m
_MOST_ITERATIONS = 50
_SMALLEST_SHARE = 1e-3


class EquilibriumStatus(Enum):
    """Outcome of the search for an equilibrium."""

    STABLE = "an equilibrium to which the arm returns"
    UNSTABLE = "an equilibrium that the arm leaves"
    NOT_FOUND = "no equilibrium was found from there"


@dataclass(frozen=True)
class Equilibrium:
    """Equilibrium of an arm.

    Attributes:
        status: the other attributes are valid only if it is STABLE or UNSTABLE.
        theta: joint angles, (n,) [rad].
        states: states of effects, (n_states,).
        stiffness: derivative of the restoring torques with respect to the joint angles, (n, n) [N m/rad].
        load: load of the equilibrium.
    """

    status: EquilibriumStatus
    theta: Array
    states: Array
    stiffness: Array
    load: Load

    @property
    def unknowns(self) -> Array:
        """Joint angles and states together, (n + n_states,)."""
        return np.concatenate([self.theta, self.states])


def equilibrium(arm: RestingArm, load: Load, start: Array | None = None) -> Equilibrium:
    """Find an equilibrium by Newton's method from ``start``.

    Without a start, or if that fails, the search increases the load from zero, starting at relaxed springs.

    Args:
        arm: the arm.
        load: tensions, and the last bending direction of the joints.
        start: joint angles near which to search, (n,) [rad].

    Raises:
        InvalidValueError: ``start`` is not finite or has the wrong size.
    """
    y = None
    if start is not None:
        y = solve_pull(arm, load, arm.unknowns(_angles(start, arm.model.n_joints), load))
    if y is None:
        y = _grown(arm, load)
    n = arm.model.n_joints
    if y is None:
        return Equilibrium(EquilibriumStatus.NOT_FOUND, np.full(n, np.nan), np.zeros(0), np.full((n, n), np.nan), load)
    stiffness = joint_stiffness(arm.pull(y, load)[1], n)
    stable = np.all(np.linalg.eigvals(stiffness).real > 0)
    status = EquilibriumStatus.STABLE if stable else EquilibriumStatus.UNSTABLE
    return Equilibrium(status, y[:n], y[n:], stiffness, load)


def solve_pull(arm: RestingArm, load: Load, y: Array, torque: Array | None = None, share: float = 1.0) -> Array | None:
    """Find joint angles and states with a net torque (n,) [N m], zero by default; return None if not found.

    Newton's method with a line search. Its steps are of minimum norm, so that states of effects that can rest anywhere
    (a bristle, for example) stay near their present values.
    """
    wanted = np.zeros(y.size)
    if torque is not None:
        wanted[: torque.size] = torque
    pull, sensitivity = arm.pull(y, load, share)
    enough = _SOLVED * max(1.0, float(np.abs(pull).max()))
    for _ in range(_MOST_ITERATIONS):
        size = float(np.abs(pull - wanted).max())
        if size <= enough:
            return y
        if not (np.isfinite(size) and np.all(np.isfinite(sensitivity))):
            return None
        step, part = np.linalg.lstsq(sensitivity, wanted - pull, rcond=1e-12)[0], 1.0
        part = min(part, 0.5 / max(float(np.abs(step).max()), 1e-300))  # rad: a larger step may reach another branch
        while part > 1e-4:
            tried, tried_sensitivity = arm.pull(y + part * step, load, share)
            if float(np.abs(tried - wanted).max()) < size:
                break
            part /= 2
        else:
            return None
        y, pull, sensitivity = y + part * step, tried, tried_sensitivity
    return None


def joint_stiffness(sensitivity: Array, n: int) -> Array:
    """Return d(joint torques) / d(angles), (n, n), with the states of effects adapting."""
    if sensitivity.shape[0] == n:
        return sensitivity
    following = -np.linalg.lstsq(sensitivity[n:, n:], sensitivity[n:, :n], rcond=1e-12)[0]
    return np.asarray(sensitivity[:n, :n] + sensitivity[:n, n:] @ following)


def _grown(arm: RestingArm, load: Load) -> Array | None:
    """Follow the equilibrium from relaxed springs as gravity and tensions grow; return None if the path ends."""
    y = arm.unknowns(np.asarray(arm.model.changed_parameters.rest_angle, dtype=float), load)
    share, step = 0.0, 1.0
    while share < 1.0:
        found = solve_pull(arm, load, y, share=min(share + step, 1.0))
        if found is None:
            step /= 2
            if step < _SMALLEST_SHARE:
                return None
            continue
        y, share, step = found, min(share + step, 1.0), 2 * step
    return y


def _angles(given: Array, n: int) -> Array:
    allowed = f"{n} finite joint angles [rad]"
    theta = finite_array("start", given, allowed)
    if theta.shape != (n,):
        raise InvalidValueError("start", given, allowed)
    return theta
