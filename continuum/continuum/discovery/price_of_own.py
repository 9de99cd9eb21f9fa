"""What an effect costs that has values for each recording: each its own, or one for all, whichever is less.

k unknowns of a recording cost k ln(n), its number of errors n (Schwarz, Annals of Statistics 6, 1978, 461-464). A
sensor's zero that is wrong by the same in every recording is one unknown, however many recordings there are: if it
paid for each, a rest angle would always be the simpler cause. Values x of R recordings are one value c for all at a
misfit of

  min_c (x - c)^T S (x - c),

with S the information on x that is left when all other unknowns follow (Gauss-Newton).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.identification.fit import Fit
from continuum.identification.free import Free


@dataclass(frozen=True)
class OneForAll:
    """What is saved where values of all recordings are taken for the same.

    Attributes:
        unknowns: how many fewer there are.
        misfit: by how much the misfit grows.
    """

    unknowns: int = 0
    misfit: float = 0.0


def own_prices(fitted: Fit) -> tuple[Array, Mapping[str, OneForAll]]:
    """Misfit that each recording's own unknowns have to be worth, (n_recordings,), and what each effect saves in it."""
    errors = np.array([run.errors_by_window.sum() for run in fitted.runs])
    own = [(i, unknown) for i, unknown in enumerate(fitted.space.unknowns) if unknown.recording is not None]
    paid, saved = np.zeros(errors.size), dict[str, OneForAll]()
    for effect in sorted({_effect(unknown) for _, unknown in own}):
        of_it = [(i, unknown) for i, unknown in own if _effect(unknown) == effect]
        members = _members([unknown for _, unknown in of_it])
        each = np.bincount([int(unknown.recording or 0) for _, unknown in of_it], minlength=errors.size)
        misfit = _misfit_of_one(fitted, [i for i, _ in of_it], members)
        price, price_of_one = each * np.log(errors), members.shape[1] * np.log(errors.sum()) + misfit
        if price_of_one < price.sum():
            price = np.full(errors.size, price_of_one / errors.size)
            saved[effect] = OneForAll(members.shape[0] - members.shape[1], misfit)
        paid += price
    return paid, saved


def _effect(unknown: Free) -> str:
    return unknown.name.partition(".")[0]


def _members(unknowns: Sequence[Free]) -> Array:
    """Which of the values that may be one for all each unknown is, as ones in (n_unknowns, n_values)."""
    values = list(dict.fromkeys((unknown.name, unknown.joint) for unknown in unknowns))
    return np.array([[float((u.name, u.joint) == value) for value in values] for u in unknowns])


def _misfit_of_one(fitted: Fit, mine: Sequence[int], members: Array) -> float:
    """Misfit of the best fit with one value for all recordings over that of the fit with one for each."""
    others = np.setdiff1d(np.arange(fitted.coordinates.size), mine)
    across = fitted.information[np.ix_(mine, others)]
    beside = np.linalg.lstsq(fitted.information[np.ix_(others, others)], across.T)[0]
    left = fitted.information[np.ix_(mine, mine)] - across @ beside
    own = fitted.coordinates[list(mine)]
    apart = own - members @ np.linalg.lstsq(members.T @ left @ members, members.T @ left @ own)[0]
    return max(float(apart @ left @ apart), 0.0)
