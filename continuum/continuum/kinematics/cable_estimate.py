"""Estimate the configurations of all sections from noisy total cable lengths: Eq. 9 generalised to many cables.

The measured lengths have independent normal errors with one common standard deviation, so the most likely
configurations are the least-squares solution over all cables. Gauss-Newton starts from the result of `untangle`; a step
that does not lower the sum of squares is damped (Levenberg-Marquardt). Unlike in `untangle`, cables that pass through a
section count as much as those that actuate it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import chdtrc

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.errors import InvalidValueError
from continuum.kinematics.configuration import bend
from continuum.kinematics.routing import tangle, tangle_jacobian, untangle

FEWEST_CABLES = 3
"""Measured cables that a section needs: two determine its configuration, and a third checks their consistency."""

TOLERANCE = 5.0
"""Largest residual that counts as noise unless another is given, in standard deviations of a length.

A normal error exceeds it once in 1.7 million samples. A residual varies less than the error of its length, because the
fit absorbs part of that error.
"""

IMPROBABLE = 1e-6
"""Probability of a larger chi-square below which lengths count as inconsistent: one false alarm in 2 h at 120 Hz."""

_STEP = 1e-4  # largest change of a length in the last step, per standard deviation or per largest residual if larger
_ROUNDING = 1e-9  # of a bend [rad]
_MOST_ITERATIONS = 50  # noisy lengths need 5 at most; lengths that no posture has may need more than this limit


class EstimateStatus(IntEnum):
    """Outcome of an estimate."""

    CONVERGED = 0
    """The configurations are the most likely ones, and the lengths agree with them."""
    INCONSISTENT = 1
    """No residual is beyond the tolerance, but chi-square is larger than noise of this size explains."""
    BEYOND_TOLERANCE = 2
    """A residual is beyond the tolerance: no posture was found that has these lengths."""
    NO_CONVERGENCE = 3
    """No residual is beyond the tolerance, but a minimum was not reached."""
    UNDETERMINED = 4
    """A section has fewer than three measured cables, or its lengths do not determine it: no configurations result."""
    BEYOND_LIMIT = 5
    """A section is bent beyond its limit by more than noise explains."""


@dataclass(frozen=True)
class CableEstimate:
    """Configurations of the sections, their covariance, and the residuals of the lengths.

    Attributes:
        status: outcome of the estimate.
        w: configurations (n_sections, 2) [rad]; NaN where undetermined. Noise may put them beyond a limit.
        covariance: of u, v of section 1, of section 2, ..., (2 n_sections, 2 n_sections) [rad^2].
        residuals: measured minus estimated total length of each cable (n_cables,) [m]; NaN where not measured.
        chi_square: sum of (residual / sd)^2.
        degrees_of_freedom: number of measured cables minus two for each section.
        iterations: number of least-squares iterations.
    """

    status: EstimateStatus
    w: Array
    covariance: Array
    residuals: Array
    chi_square: float
    degrees_of_freedom: int
    iterations: int

    def section_covariance(self, index: int) -> Array:
        """Return the covariance (2, 2) [rad^2] of u and v of section ``index`` (0 at the base)."""
        of_section = slice(2 * index, 2 * index + 2)
        return self.covariance[of_section, of_section]

    def bend_sd(self, index: int) -> float:
        """Return the standard deviation [rad] of the bend of section ``index``, along its bending direction."""
        u, v = self.w[index]
        outward = np.array([u, v]) / max(np.hypot(u, v), np.finfo(float).tiny)
        return float(np.sqrt(outward @ self.section_covariance(index) @ outward))


def estimate_configuration(totals: ArrayLike, arm: Arm, sd: float, tolerance: float | None = None) -> CableEstimate:
    """Return the maximum likelihood estimate of all configurations from measured total lengths.

    Args:
        totals: measured lengths (n_cables,) [m] from the base to each cable's anchor, in the order of `tangle`; NaN
            where a cable was not measured.
        arm: the arm.
        sd: standard deviation of a measured length [m].
        tolerance: largest residual that counts as noise [m]; None stands for `TOLERANCE` times ``sd``.

    Raises:
        InvalidValueError: the number of lengths is wrong, a length is infinite, or ``sd`` is not positive and finite.
    """
    totals = np.asarray(totals, dtype=float)
    if totals.shape != (len(arm.cable_names),) or np.isinf(totals).any():
        raise InvalidValueError("totals", totals.tolist(), f"{len(arm.cable_names)} lengths, NaN where not measured")
    if not 0.0 < sd < np.inf:
        raise InvalidValueError("sd", sd, "more than 0 m, finite")
    known = ~np.isnan(totals)
    measured = arm_of_cables(arm, tuple(known.tolist()))
    if measured is None:
        return _undetermined(arm, totals)
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            fit = _least_squares(totals[known], measured, sd)
            covariance = sd**2 * np.linalg.inv(fit.jacobian.T @ fit.jacobian)
            chi_square = float(np.sum((fit.residuals / sd) ** 2))
    except np.linalg.LinAlgError:
        return _undetermined(arm, totals)
    residuals = np.full(totals.shape, np.nan)
    residuals[known] = fit.residuals
    freedom = len(fit.residuals) - fit.w.size
    found = CableEstimate(EstimateStatus.CONVERGED, fit.w, covariance, residuals, chi_square, freedom, fit.iterations)
    largest = float(np.abs(fit.residuals).max())
    status = _status(found, largest, TOLERANCE * sd if tolerance is None else tolerance, arm, converged=fit.converged)
    return replace(found, status=status)


def _status(found: CableEstimate, largest: float, tolerance: float, arm: Arm, *, converged: bool) -> EstimateStatus:
    """Return the outcome of an estimate from its ``largest`` residual [m] and the ``tolerance`` [m]."""
    if not largest <= tolerance:
        return EstimateStatus.BEYOND_TOLERANCE
    if not converged:
        return EstimateStatus.NO_CONVERGENCE
    if _is_beyond_a_limit(found, arm):
        return EstimateStatus.BEYOND_LIMIT
    if chdtrc(found.degrees_of_freedom, found.chi_square) < IMPROBABLE:
        return EstimateStatus.INCONSISTENT
    return EstimateStatus.CONVERGED


def _is_beyond_a_limit(found: CableEstimate, arm: Arm) -> bool:
    """Return whether a bend exceeds its section's limit by more than `TOLERANCE` standard deviations plus rounding.

    Estimates are unbiased and not clipped to a limit: at the limit, half of them lie beyond it.
    """
    excess = bend(found.w) - [section.bend_limit for section in arm.sections]
    sd = np.array([found.bend_sd(i) for i in range(arm.n_sections)])
    return bool(np.any(excess > TOLERANCE * sd + _ROUNDING))


@lru_cache
def arm_of_cables(arm: Arm, known: tuple[bool, ...]) -> Arm | None:
    """Return the arm with only its ``known`` cables; None if a section keeps fewer than three."""
    if all(known):
        return arm
    sections, first = [], 0
    for section in arm.sections:
        actuating = known[first : first + len(section.cable_azimuths)]
        first += len(actuating)
        azimuths = tuple(azimuth for azimuth, one in zip(section.cable_azimuths, actuating, strict=True) if one)
        if len(azimuths) < FEWEST_CABLES:
            return None
        sections.append(replace(section, cable_azimuths=azimuths))
    return Arm(tuple(sections))


class _Fit(NamedTuple):
    """Configurations (n_sections, 2) [rad], with residuals (n_cables,) [m] and their jacobian there."""

    w: Array
    residuals: Array
    jacobian: Array
    iterations: int
    converged: bool


def _least_squares(totals: Array, arm: Arm, sd: float) -> _Fit:
    """Minimise the sum of squared residuals.

    Raises:
        LinAlgError: the lengths do not determine all configurations.
    """
    w, damping = untangle(totals, arm), 0.0
    residuals, jacobian = totals - tangle(w, arm), tangle_jacobian(w, arm)
    for iteration in range(1, _MOST_ITERATIONS + 1):
        normal = jacobian.T @ jacobian
        step = np.linalg.solve(normal + damping * np.diag(normal.diagonal()), jacobian.T @ residuals)
        new_w = w + step.reshape(w.shape)
        new_residuals = totals - tangle(new_w, arm)
        undamped_change = (1.0 + damping) * np.abs(jacobian @ step).max()
        if undamped_change <= _STEP * max(sd, np.abs(residuals).max()):
            return _Fit(new_w, new_residuals, jacobian, iteration, converged=True)
        if new_residuals @ new_residuals < residuals @ residuals:
            w, residuals, jacobian, damping = new_w, new_residuals, tangle_jacobian(new_w, arm), 0.1 * damping
        else:
            damping = max(10.0 * damping, 1e-3)
    return _Fit(w, residuals, jacobian, _MOST_ITERATIONS, converged=False)


def _undetermined(arm: Arm, totals: Array) -> CableEstimate:
    size = 2 * arm.n_sections
    return CableEstimate(
        status=EstimateStatus.UNDETERMINED,
        w=np.full((arm.n_sections, 2), np.nan),
        covariance=np.full((size, size), np.nan),
        residuals=np.full(totals.shape, np.nan),
        chi_square=np.nan,
        degrees_of_freedom=int(np.count_nonzero(~np.isnan(totals))) - size,
        iterations=0,
    )
