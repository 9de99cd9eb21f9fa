"""Constant curvature and the dynamic model compared with a measured posture: distances, and which model is nearer.

Both models bend by the measured total. With the residuals r of the joint angles,

    D = |r| / sqrt(n),    S = D_dynamic^2 - D_constant^2,    D_dynamic - D_constant = S / (D_dynamic + D_constant)

S decides, not the difference: measurement errors increase both distances, the shorter one most, but cancel in S, which
is linear in the measured angles except for their total. The result is undecided if S is within 1.96 of its standard
deviations of 0, or if the models are as close to each other as 1.96 standard deviations of an angle, as in a nearly
straight arm. Residuals follow the measured angles theta by dr/dtheta = I - m 1^T, where m is the change of the model
with the total bend: 1/n at every joint, or that of the dynamic model.
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
from continuum.dynamics.planar.backbone import backbone
from continuum.dynamics.statics.resting_arm import RestingArm
from continuum.errors import InvalidValueError

LEVEL = 1.959964
"""Standard deviations from the mean of a normal distribution to its 2.5 and 97.5 % quantiles."""


class Nearer(Enum):
    """Which model is nearer to what was measured."""

    DYNAMIC = "dynamic model"
    CONSTANT = "constant curvature"
    UNDECIDED = "undecided"


@dataclass(frozen=True)
class Distance:
    """A distance and its standard deviation [rad or m]."""

    value: float
    sd: float

    @property
    def low(self) -> float:
        """2.5 % quantile, at least 0."""
        return max(self.value - LEVEL * self.sd, 0.0)

    @property
    def high(self) -> float:
        """97.5 % quantile."""
        return self.value + LEVEL * self.sd


@dataclass(frozen=True)
class Comparison:
    """Comparison of one posture.

    Attributes:
        p: parameters of the arm.
        theta: measured joint angles, (n,) [rad].
        covariance: covariance of their errors, (n, n) [rad^2].
        held: posture of the dynamic model with the same total bend.
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
        """2.5 and 97.5 % quantiles of the measured angles, (2, n) [rad]."""
        reach = LEVEL * np.sqrt(np.diag(self.covariance))
        return np.stack([self.theta - reach, self.theta + reach])

    @property
    def beyond_friction(self) -> NDArray[np.intp]:
        """Joints, from 0, whose whole interval is outside the range that dry friction holds in the dynamic model."""
        low, high = self.quantiles
        return np.flatnonzero((high < self.held.zone.lower) | (low > self.held.zone.upper))

    @cached_property
    def angles_to_constant(self) -> Distance:
        """Distance to constant curvature, root mean square over the joints [rad]."""
        return self._of_angles(self.constant, np.full(self.theta.size, 1 / self.theta.size))

    @cached_property
    def angles_to_dynamic(self) -> Distance:
        """Distance to the dynamic model, root mean square over the joints [rad]."""
        return self._of_angles(self.held.theta, self.held.derivative)

    @cached_property
    def tip_to_constant(self) -> Distance:
        """Distance to the tip of constant curvature, in the plane [m]."""
        return self._of_tip(self.constant, np.full(self.theta.size, 1 / self.theta.size))

    @cached_property
    def tip_to_dynamic(self) -> Distance:
        """Distance to the tip of the dynamic model, in the plane [m]."""
        return self._of_tip(self.held.theta, self.held.derivative)

    @cached_property
    def difference(self) -> tuple[float, Array]:
        """S [rad^2] and its derivatives with respect to the measured angles, (n,) [rad]."""
        n, even = self.theta.size, self.theta - self.constant
        uneven = self.theta - self.held.theta
        derivatives = 2 / n * (uneven @ _following(self.held.derivative) - even)
        return float(uneven @ uneven - even @ even) / n, derivatives

    @property
    def nearer(self) -> Nearer:
        """Nearer model by this posture alone."""
        if not self.resolved:
            return Nearer.UNDECIDED
        s, derivatives = self.difference
        return _nearer(s, float(np.sqrt(derivatives @ self.covariance @ derivatives)))

    @property
    def models_apart(self) -> float:
        """Root mean square distance between the two models [rad]."""
        return float(np.sqrt(np.mean((self.held.theta - self.constant) ** 2)))

    @property
    def resolved(self) -> bool:
        """Whether the distance between the models exceeds the uncertainty of an angle."""
        return self.models_apart > LEVEL * float(np.sqrt(np.mean(np.diag(self.covariance))))

    @property
    def closer_by(self) -> Distance:
        """Difference of the two distances, by which the nearer model is nearer [rad]."""
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
    """Comparison of several postures together.

    Attributes:
        to_constant, to_dynamic: root mean square distance over joints and postures [rad].
        closer_by: difference of the two distances, by which the nearer model is nearer [rad].
        nearer: nearer model over all postures; undecided if single postures contradict each other.
        counts: number of postures with each answer.
    """

    to_constant: float
    to_dynamic: float
    closer_by: Distance
    nearer: Nearer
    counts: dict[Nearer, int]


def compare(
    arm: RestingArm, theta: Array, covariance: Array, tension: Array | None = None, approach: int = 0
) -> Comparison:
    """Compare both models with measured joint angles.

    Args:
        arm: arm of the dynamic model.
        theta: measured joint angles, (n,) [rad].
        covariance: covariance of their errors, (n, n) [rad^2].
        tension: tension of each cable at the base, (2,) [N]; None if unknown.
        approach: direction of the last bending: 1 towards positive angles, -1 towards negative ones, 0 from straight.

    Raises:
        InvalidValueError: the arm has only one joint or another number than was measured, or the model cannot hold the
            bend.
    """
    n = arm.model.n_joints
    if n < 2:
        raise InvalidValueError("number of joints", n, "2 or more: one joint has no curvature that could vary")
    if theta.shape != (n,):
        raise InvalidValueError("number of joints", theta.size, f"{n}, as in the model")
    total = float(theta.sum())
    side = approach or (1 if total > 0 else -1)
    return Comparison(arm.model.parameters, theta, covariance, held_posture(arm, total, tension, side))


def overall(each: Sequence[Comparison], errors: MedianErrors) -> Overall:
    """Return one answer for several postures; their errors within a recording are not independent."""
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
    """Return S as a difference of distances; both are 0 where the models agree with each other and with the arm."""
    return Distance(abs(s) / both, sd / both) if both > 0 else Distance(0.0, 0.0)


def _following(derivative: Array) -> Array:
    """Return dr/dtheta of a model that changes by ``derivative`` (n,) with the total bend, (n, n)."""
    return np.asarray(np.eye(derivative.size) - np.outer(derivative, np.ones(derivative.size)))


def _length(vector: Array, by_theta: Array, covariance: Array) -> Distance:
    """Return the length of a vector (m,) and its error, from the vector's derivatives (m, n)."""
    length, moved = float(np.linalg.norm(vector)), by_theta @ covariance @ by_theta.T
    if length == 0:
        return Distance(0.0, float(np.sqrt(np.trace(moved))))
    return Distance(length, math.sqrt(max(float(vector @ moved @ vector), 0.0)) / length)


def _tip(theta: Array, p: Parameters) -> tuple[Array, Array]:
    """Return the tip in the plane, (2,) [m], and its derivatives with respect to the joint angles, (2, n).

    A joint turns all that is beyond it.
    """
    points = backbone(theta, p)
    arms = points[-1] - points[1:-1]
    return points[-1], np.stack([-arms[:, 1], arms[:, 0]])
