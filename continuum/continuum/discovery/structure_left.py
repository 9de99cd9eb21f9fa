"""Is what a model leaves of the data noise, or has it structure?

Errors are made independent and of unit variance by the sensors' covariance, so that those of a right model have a flat
spectrum. A model that lacks something leaves slow errors: the arm moves at some hertz, the sensors see up to 60. The
energy of the slow part, beside what noise alone would give it, is the measure; it knows no model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.fft import dct
from scipy.stats import chi2

from continuum.arrays import Array
from continuum.identification.run_residual import Errors

_SLOW = 10.0  # Hz: what the arm's motion and its mistakes contain
_NOISE = 25.0  # Hz: above, nothing but noise


@dataclass(frozen=True)
class StructureLeft:
    """Energy of slow errors beside that of noise.

    Attributes:
        excess: energy of the slow errors in units of what noise gives them, less 1; 0 for a right model.
        p_value: probability of as much or more by noise alone.
        by_run, by_joint: the same excess run by run (n_runs,) and joint by joint (n_joints,).
    """

    excess: float
    p_value: float
    by_run: Array
    by_joint: Array


def structure_left(errors: Sequence[Errors], times: Sequence[Array], fitted: float) -> StructureLeft:
    """Structure in the errors of several runs.

    Args:
        errors: of each run, whitened.
        times: of their samples [s].
        fitted: number of unknowns that were fitted to each run, its share of the common ones included.
    """
    slow, noise = [], []
    for run, t in zip(errors, times, strict=True):
        rate = (t.size - 1) / (t[-1] - t[0])
        for channel in (run.angle, run.rate):
            if channel is None:
                continue
            energy = dct(channel, axis=0, norm="ortho") ** 2  # frequency k rate / (2 n_times)
            edge = max(1, int(2 * t.size * _SLOW / rate)), int(2 * t.size * _NOISE / rate)
            slow.append((energy[: edge[0]].sum(axis=0), edge[0]))
            noise.append(energy[edge[1] :])
    level = _noise_level(noise)
    channels = len(slow) // len(errors)
    total = np.array([energy for energy, _ in slow]).reshape(len(errors), channels, -1).sum(axis=1) / level
    count = np.array([size for _, size in slow]).reshape(len(errors), channels).sum(axis=1)
    left = np.maximum(count * total.shape[1] - fitted, 1)  # degrees of freedom, (n_runs,)
    share = left / (count * total.shape[1])
    energy, freedom = float(total.sum()), float(left.sum())
    return StructureLeft(
        energy / freedom - 1,
        float(chi2.sf(energy, freedom)),
        total.sum(axis=1) / left - 1,
        total.sum(axis=0) / float((count * share).sum()) - 1,
    )


def _noise_level(fast: Sequence[Array]) -> float:
    """Energy of the fast errors, 1 where the noise was estimated well; never less, as kinks may hide in the estimate."""
    energies = np.concatenate([energy.ravel() for energy in fast])
    return max(1.0, float(np.mean(energies))) if energies.size else 1.0
