"""Whether what a trial explains is worth its unknowns: Schwarz's criterion with the effective number of samples.

  BIC = 2 cost + k ln(n_eff),  n_eff = n (1 - r) / (1 + r),

with k unknowns that runs share or have for themselves, those counted as one that may be the same in all
(`price_of_own`), and n errors, which are independent within a window of a right model; r is how alike the misfits of
neighbouring windows are, which what is missing makes alike (Schwarz, Annals of Statistics 6, 1978, 461-464; Bayley and
Hammersley, J. R. Statist. Soc. Suppl. 8, 1946, 184-197, of a first-order process).
"""

from __future__ import annotations

import numpy as np

from continuum.discovery.trial import Trial

_LEAST = 2.0  # samples


def information_gain(trial: Trial, over: Trial) -> float:
    """Half of what the criterion falls by from one trial to another of the same data: log-likelihood less its price."""
    price = (_count(trial) - _count(over)) * np.log(effective_number(trial))
    return float(_cost(over) - _cost(trial) - price / 2)


def _count(trial: Trial) -> int:
    return len(trial.unknowns) - trial.one_for_all.unknowns


def _cost(trial: Trial) -> float:
    return trial.cost + trial.one_for_all.misfit / 2


def effective_number(trial: Trial) -> float:
    """Of independent errors among all."""
    deviations = [misfit / size - 1.0 for misfit, size in zip(trial.held_out, trial.sizes, strict=True)]
    mean = np.mean(np.concatenate(deviations))
    centred = [run - mean for run in deviations]
    products = sum(float(run[:-1] @ run[1:]) for run in centred)
    squares = sum(float(run[:-1] @ run[:-1] + run[1:] @ run[1:]) / 2 for run in centred)
    r = float(np.clip(products / squares, 0.0, 1.0)) if squares > 0 else 0.0
    return max(float(np.sum(np.concatenate(trial.sizes))) * (1 - r) / (1 + r), _LEAST)
