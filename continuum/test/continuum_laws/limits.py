"""What bend limits make of a wish: the part of it that nothing holds up."""

import numpy as np
from scipy.optimize import nnls

from continuum.arm import Arm
from continuum.kinematics.configuration import bend
from continuum_laws.samples import limits_of


def free_part(arm: Arm, w: np.ndarray, wish: np.ndarray, fixed: np.ndarray) -> float:
    """Norm of what is left of ``wish`` (n_sections, 2) at ``w`` (n_sections, 2) [rad] within constraints.

    Rows of ``fixed`` (m, 2 n_sections) may not be noticed; sections at their limit may not bend further, but unbend. It
    is zero where, and only where, ``w`` is stationary (Karush, Kuhn and Tucker).
    """
    outward = np.zeros((0, w.size))
    for i in np.flatnonzero(bend(w) >= limits_of(arm) * (1.0 - 1e-8)):
        row = np.zeros((1, w.size))
        row[0, 2 * i : 2 * i + 2] = w[i] / bend(w[i])
        outward = np.concatenate([outward, row])
    scaled = fixed / max(1e-300, np.max(np.abs(fixed), initial=0.0))
    return float(nnls(np.concatenate([scaled, -scaled, outward]).T, wish.reshape(-1), maxiter=1000)[1])
