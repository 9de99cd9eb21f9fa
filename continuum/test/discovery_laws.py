"""Trials and fits made by hand, whose evidence is known."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from dynamics_laws import prototype_model

from continuum.discovery.candidate import Addition, Extension, extended
from continuum.discovery.round import Round
from continuum.discovery.trial import Trial
from continuum.identification.arrow_least_squares import FitStatus, Part, Unknowns
from continuum.identification.fit import Fit
from continuum.identification.free import Free, FreeSpace

RUNS, WINDOWS, SIZE = 4, 25, 40.0
"""Runs, windows of each, errors in each of these."""


def trial(*effects: str | Addition, bad: float = 0.0, misfit: float = 1.0, seed: int = 0) -> Trial:
    """A trial whose windows are explained but for a share.

    Args:
        effects: of its extension.
        bad: share of the windows that stay unexplained, everywhere alike.
        misfit: of the others, in units of noise.
        seed: of the scatter of the misfits.
    """
    random = np.random.default_rng(seed)
    relative = misfit * (1 + 0.05 * random.normal(size=RUNS * WINDOWS))
    relative[np.linspace(0, relative.size - 1, round(bad * relative.size)).astype(int)] = 5.0
    extension: Extension = tuple(Addition(one) if isinstance(one, str) else one for one in effects)
    none = np.zeros(0)
    return Trial(
        extension, FitStatus.CONVERGED, (), none, none, (), SIZE * float(relative.sum()) / 2,
        tuple(SIZE * run for run in relative.reshape(RUNS, WINDOWS)), (np.full(WINDOWS, SIZE),) * RUNS, 1,
    )  # fmt: skip


def a_round(before: Trial, *leaders: Trial) -> Round:
    return Round(before, leaders, leaders)


def quadratic(effect: str, found: Sequence[float], precision: np.ndarray, joints: int = 5) -> Fit:
    """A fit of one effect at every joint, whose cost is a parabola around what was found."""
    model = extended(prototype_model(joints), (Addition(effect),))
    names = [name for name in model.values() if name.startswith(f"{effect}.")]
    unknowns = [Free(name, j) for name in names for j in range(joints)]
    space, k = FreeSpace(model, unknowns), len(unknowns)
    root = np.linalg.cholesky(precision).T
    part = Part(np.ones(k), root, np.zeros((k, 0)))  # errors of unit size weigh 1
    far = np.full(k, np.inf)
    where = Unknowns(np.array(found, dtype=float), np.full(k, 1e6), -far, far, [np.zeros(0)], [np.zeros(0)])
    return Fit(FitStatus.CONVERGED, None, space, [], where, [part], 0.0, 1)  # type: ignore[arg-type]
