"""At which joints an effect acts, when it was fitted to all of them: the fewest that explain what all explain.

Or all of them, where one value for all joints explains no less than those few: an effect of the whole arm is one
cause with fewer unknowns, and the few stand for it.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.fit import Fit

_PART = 0.85  # of what all joints gain must be gained by those named
_PART_OF_RUNS = 0.995  # the same, of an effect whose every joint has a value of its own in every run, as sensors' zeros
_ENOUGH = 8.0  # or all but this much log-likelihood


def acting_joints(fitted: Fit, effect: str) -> tuple[int, ...]:
    """Joints that are named, from 0, those that explain most first; all where no few of them do.

    Near the fit the cost is a parabola in the effect's own unknowns, the others following; what is lost by holding
    some of them at zero is read off it.
    """
    unknowns = fitted.space.unknowns
    mine = [i for i, unknown in enumerate(unknowns) if unknown.name.startswith(effect + ".")]
    by_joint = {j: [at for at, i in enumerate(mine) if unknowns[i].joint == j] for j in _joints(fitted, mine)}
    common = [at for at, i in enumerate(mine) if unknowns[i].joint is None]
    precision = np.linalg.inv(np.linalg.inv(fitted.information)[np.ix_(mine, mine)])
    found = fitted.coordinates[mine]
    whole = _loss(precision, found, common)
    anew = any(parameter.per_recording for parameter in effect_named(effect).parameters.values())
    least = max((1 - (_PART_OF_RUNS if anew else _PART)) * whole, _ENOUGH)
    chosen, left = list[int](), whole
    while len(chosen) < len(by_joint):
        losses = {
            j: _loss(precision, found, common + [at for k in (*chosen, j) for at in by_joint[k]])
            for j in by_joint
            if j not in chosen
        }
        best = min(losses, key=lambda j: losses[j])
        chosen.append(best)
        left = losses[best]
        if left < least:
            break
    if len(chosen) > 1 and _loss_of_one(precision, found, common, by_joint) <= left:
        return (*chosen, *(j for j in by_joint if j not in chosen))
    return tuple(chosen)


def _joints(fitted: Fit, mine: list[int]) -> list[int]:
    return sorted({j for i in mine if (j := fitted.space.unknowns[i].joint) is not None})


def _loss_of_one(precision: Array, found: Array, common: list[int], by_joint: dict[int, list[int]]) -> float:
    """The same with each of the effect's values one and the same at all joints, and what is common free."""
    at_joints = np.array([by_joint[j] for j in by_joint])  # (n_joints, n_values)
    free = np.zeros((found.size, at_joints.shape[1] + len(common)))
    for k in range(at_joints.shape[1]):
        free[at_joints[:, k], k] = 1.0
    free[common, np.arange(at_joints.shape[1], free.shape[1])] = 1.0
    away = found - free @ np.linalg.solve(free.T @ precision @ free, free.T @ precision @ found)
    return float(away @ precision @ away / 2)


def _loss(precision: Array, found: Array, free: list[int]) -> float:
    """Least value of (z - found)^T precision (z - found) / 2 with z zero but at ``free``."""
    held = [i for i in range(found.size) if i not in free]
    if not held:
        return 0.0
    away = found[held]
    inner = precision[np.ix_(held, held)]
    if free:
        cross = precision[np.ix_(held, free)]
        inner = inner - cross @ np.linalg.solve(precision[np.ix_(free, free)], cross.T)
    return float(away @ inner @ away / 2)
