"""Constant curvature and the dynamic model beside a measured posture: how far each is from it, and which is nearer.

Both models bend by the measured total. With the residuals r of the joint angles,

    D = |r| / sqrt(n),    S = D_dynamic^2 - D_constant^2,    D_dynamic - D_constant = S / (D_dynamic + D_constant)

S decides, not the difference: measuring errors lengthen both distances, most the shorter one, but cancel in S, which is
linear in the measured angles but for the totals. The measurement cannot tell where S is within 1.96 of its standard
deviations, nor where the models are as near to each other as 1.96 standard deviations of an angle, as in an arm that is
nearly straight. Residuals follow the measured angles theta by dr/dtheta = I - m 1^T, m being the model's own change
with the total bend: 1/n at every joint, or the dynamic model's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.curvature.held_posture import HeldPosture, held_posture
from continuum.curvature.median_error import MedianErrors
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.statics.resting_arm import RestingArm
from continuum.errors import InvalidValueError
from continuum.recordings.motion_figure import backbone

LEVEL = 1.959964
"""Standard deviations from the middle of a normal distribution to its quantiles of 2.5 and 97.5 %."""


class Nearer(Enum):
    """Which model is nearer to what was measured."""

    DYNAMIC = "dynamic model"
    CONSTANT = "constant curvature"
    UNDECIDED = "cannot be told"


@dataclass(frozen=True)
class Distance:
    """A distance and its standard deviation [rad or m]."""

    value: float
    sd: float

    @property
    def low(self) -> float:
        """Quantile of 2.5 %, 0 at least."""
        return max(self.value - LEVEL * self.sd, 0.0)

    @property
    def high(self) -> float:
        """Quantile of 97.5 %."""
        return self.value + LEVEL * self.sd


@dataclass(frozen=True)
class Comparison:
    """One posture.

    Attributes:
        p: parameters of the arm.
        theta: measured joint angles, (n,) [rad].
        covariance: of their errors, (n, n) [rad^2].
        held: the dynamic model's posture with the same total bend.
    """

    p: Parameters
    theta: Array
    covariance: Array
    held: HeldPosture

    @property
    def constant(self) -> Array:
        """Joint angles of constant curvature, (n,) [rad]."""
        return np.full(self.theta.size, self.theta.mean())

    @property
    def quantiles(self) -> Array:
        """Quantiles of 2.5 and 97.5 % of the measured angles, (2, n) [rad]."""
        reach = LEVEL * np.sqrt(np.diag(self.covariance))
        return np.stack([self.theta - reach, self.theta + reach])

    @property
    def beyond_friction(self) -> NDArray[np.intp]:
        """Joints, from 0, whose whole interval is outside of what dry friction holds in the dynamic model."""
        low, high = self.quantiles
        return np.flatnonzero((high < self.held.zone.lower) | (low > self.held.zone.upper))

    @cached_property
    def angles_to_constant(self) -> Distance:
        """Root mean square over the joints [rad]."""
        return self._of_angles(self.constant, np.full(self.theta.size, 1 / self.theta.size))

    @cached_property
    def angles_to_dynamic(self) -> Distance:
        """The same."""
        return self._of_angles(self.held.theta, self.held.derivative)

    @cached_property
    def tip_to_constant(self) -> Distance:
        """Between tips in the plane [m]."""
        return self._of_tip(self.constant, np.full(self.theta.size, 1 / self.theta.size))

    @cached_property
    def tip_to_dynamic(self) -> Distance:
        """The same."""
        return self._of_tip(self.held.theta, self.held.derivative)

    @cached_property
    def difference(self) -> tuple[float, Array]:
        """S [rad^2] and its slopes by the measured angles, (n,) [rad]."""
        n, even = self.theta.size, self.theta - self.constant
        uneven = self.theta - self.held.theta
        derivatives = 2 / n * (uneven @ _following(self.held.derivative) - even)
        return float(uneven @ uneven - even @ even) / n, derivatives

    @property
    def nearer(self) -> Nearer:
        """By this posture alone."""
        if not self.resolved:
            return Nearer.UNDECIDED
        s, derivatives = self.difference
        return _nearer(s, float(np.sqrt(derivatives @ self.covariance @ derivatives)))

    @property
    def models_apart(self) -> float:
        """Root mean square distance of the two models from each other [rad]."""
        return float(np.sqrt(np.mean((self.held.theta - self.constant) ** 2)))

    @property
    def resolved(self) -> bool:
        """Whether they are further from each other than an angle is measured exactly."""
        return self.models_apart > LEVEL * float(np.sqrt(np.mean(np.diag(self.covariance))))

    @property
    def closer_by(self) -> Distance:
        """By how much the nearer model is nearer [rad]."""
        s, derivatives = self.difference
        return _closer(s, float(np.sqrt(derivatives @ self.covariance @ derivatives)), self._both)

    @property
    def _both(self) -> float:
        return self.angles_to_constant.value + self.angles_to_dynamic.value

    def _of_angles(self, model: Array, derivative: Array) -> Distance:
        away = (self.theta - model) / np.sqrt(self.theta.size)
        return _length(away, _following(derivative) / np.sqrt(self.theta.size), self.covariance)

    def _of_tip(self, model: Array, derivative: Array) -> Distance:
        (here, by_here), (there, by_there) = _tip(self.theta, self.p), _tip(model, self.p)
        return _length(
            here - there, by_here - np.outer(by_there @ derivative, np.ones(derivative.size)), self.covariance
        )


@dataclass(frozen=True)
class Overall:
    """Several postures together.

    Attributes:
        to_constant, to_dynamic: root mean square distance over joints and postures [rad].
        closer_by: by how much the nearer model is nearer [rad].
        nearer: over all; not told where single postures contradict each other.
        counts: of the postures' own answers.
    """

    to_constant: float
    to_dynamic: float
    closer_by: Distance
    nearer: Nearer
    counts: dict[Nearer, int]


def compare(
    arm: RestingArm, theta: Array, covariance: Array, tension: Array | None = None, approach: int = 0
) -> Comparison:
    """Both models beside measured joint angles.

    Args:
        arm: of the dynamic model.
        theta: measured, (n,) [rad].
        covariance: of their errors, (n, n) [rad^2].
        tension: of each cable at the base, (2,) [N]; None where it is not known.
        approach: which way the arm bent last: 1 towards positive angles, -1 towards negative ones, 0: from straight.

    Raises:
        InvalidValueError: the arm has one joint or another number than was measured, or the model cannot hold the bend.
    """
    n = arm.model.n_joints
    if n < 2:
        raise InvalidValueError("number of joints", n, "2 or more: one joint has no curvature that could vary")
    if theta.shape != (n,):
        raise InvalidValueError("number of joints", theta.size, f"{n}, as the model has")
    total = float(theta.sum())
    side = approach or (1 if total > 0 else -1)
    return Comparison(arm.model.parameters, theta, covariance, held_posture(arm, total, tension, side))


def overall(each: Sequence[Comparison], errors: MedianErrors) -> Overall:
    """One answer for several postures, whose errors are not independent of each other within a recording."""
    s = float(np.mean([one.difference[0] for one in each]))
    derivatives = np.stack([one.difference[1] for one in each]) / len(each)
    sd = float(np.sqrt(errors.variance(derivatives)))
    constant = _root_mean_square([one.angles_to_constant for one in each])
    dynamic = _root_mean_square([one.angles_to_dynamic for one in each])
    counts = {kind: sum(one.nearer is kind for one in each) for kind in Nearer}
    contradict = counts[Nearer.DYNAMIC] > 0 and counts[Nearer.CONSTANT] > 0
    nearer = Nearer.UNDECIDED if contradict else _nearer(s, sd)
    return Overall(constant, dynamic, _closer(s, sd, constant + dynamic), nearer, counts)


def _root_mean_square(distances: Sequence[Distance]) -> float:
    return math.sqrt(sum(one.value**2 for one in distances) / len(distances))


def _nearer(s: float, sd: float) -> Nearer:
    if abs(s) <= LEVEL * sd:
        return Nearer.UNDECIDED
    return Nearer.DYNAMIC if s < 0 else Nearer.CONSTANT


def _closer(s: float, sd: float, both: float) -> Distance:
    """S as a difference of distances; both of them are 0 where the models agree with each other and with the arm."""
    return Distance(abs(s) / both, sd / both) if both > 0 else Distance(0.0, 0.0)


def _following(derivative: Array) -> Array:
    """dr/dtheta of a model that changes by ``derivative`` (n,) with the total bend, (n, n)."""
    return np.asarray(np.eye(derivative.size) - np.outer(derivative, np.ones(derivative.size)))


def _length(vector: Array, by_theta: Array, covariance: Array) -> Distance:
    """Length of a vector (m,) and its error, by the vector's slopes (m, n)."""
    length, moved = float(np.linalg.norm(vector)), by_theta @ covariance @ by_theta.T
    if length == 0:
        return Distance(0.0, float(np.sqrt(np.trace(moved))))
    return Distance(length, math.sqrt(max(float(vector @ moved @ vector), 0.0)) / length)


def _tip(theta: Array, p: Parameters) -> tuple[Array, Array]:
    """Tip in the plane, (2,) [m], and its slopes by the joint angles, (2, n): a joint turns all that is beyond it."""
    points = backbone(theta, p)
    arms = points[-1] - points[1:-1]
    return points[-1], np.stack([-arms[:, 1], arms[:, 0]])
