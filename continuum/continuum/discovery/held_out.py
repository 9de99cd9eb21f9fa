"""How well a fitted model explains a run that it was not fitted to, for every run, without a fit for each.

Windows are nearly linear in the shared unknowns, so that the fit without a run follows from the fit with it by one
step of Newton's method (Cook 1977, for whole runs instead of single points): x + (H - H_r)^-1 g_r.

What the other runs leave uncertain makes a prediction uncertain, and counts as such (log predictive density). Windows
of a run are predicted one after another, each also by those before it: a value that one run alone tells is paid for
where it first shows, and the run's later windows have to agree with it. Of a window's errors e with slopes J the
misfit is

  e^T C^-1 e + log det C,     C = I + J (H - H_s)^-1 J^T,

with H_s the information of this window and of those of its run that come after it. Summed over a run that is minus
twice the logarithm of the density of all its windows given the other runs (chain rule), but for a constant.

A badly explained window, of a weight w < 1 in the fit, tells the others less by that, and may agree with them no better
for it: J^T J above is w J^T J.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.discovery.price_of_own import own_prices
from continuum.identification.arrow_least_squares import MOST_MISFIT, misfit, reduced, weight_of
from continuum.identification.fit import Fit


def held_out_misfits(fitted: Fit) -> list[Array]:
    """Misfit of every window of every run, each run predicted by the others.

    What belongs to a run alone, its windows' first states and its sensors' offsets, is the run's own; each such offset
    is paid for, or as one where it may be the same in all runs (`price_of_own`), and what is uncertain of the effects'
    states where it begins with what it took of its prior (Laplace's method). With one run, stretches of it
    are held out instead. A model that could not be simulated explains no window.
    """
    groups, single = _groups(fitted), len(fitted.runs) == 1
    if not fitted.parts:
        nothing = MOST_MISFIT * np.concatenate([run.errors_by_window for run in fitted.runs])
        return [nothing[group] for group in groups]
    slopes = [reduced(part, spread) for part, spread in zip(fitted.parts, fitted.unknowns.own_spread, strict=True)]
    space, at = fitted.space, fitted.coordinates
    at_bound = (at <= space.lower) | (at >= space.upper)  # no small step leads away from there
    found: list[Array] = []
    prices_of_own, _ = own_prices(fitted)
    for number, group in enumerate(groups):
        mine = np.array([u.recording == number and not single for u in space.unknowns], dtype=bool)
        known, price = mine | at_bound, 0.0 if single else prices_of_own[number] / len(group)
        left, pull = fitted.information.copy(), np.zeros(mine.size)
        misfits = []
        for i in reversed(group):
            errors, weight = fitted.parts[i].errors, weight_of(fitted.parts[i])
            left -= weight * slopes[i].T @ slopes[i]
            pull += weight * slopes[i].T @ errors
            uncertain = _uncertain(left, fitted.unknowns.spread, known)
            step = np.clip(at + uncertain @ (uncertain.T @ pull), space.lower, space.upper) - at
            predicted = _predicted(errors + slopes[i] @ step, np.sqrt(weight) * slopes[i] @ uncertain)
            misfits.append(predicted + price + _price_of_states(fitted, i))
        found.append(np.array(misfits[::-1]))
    return found


def _uncertain(information: Array, spread: Array, known: NDArray[np.bool_]) -> Array:
    """A root U of the covariance U U^T of unknowns (k,) of such information, (k, k), but for those that are known.

    No unknown is less known than by its prior, of standard deviation ``spread``; rounding may say otherwise where
    others are known a million times better.
    """
    scaled = spread[:, None] * information * spread
    scaled[known] = scaled[:, known] = 0.0
    scaled[known, known] = 1.0
    eigenvalues, vectors = np.linalg.eigh(scaled)
    root = spread[:, None] * vectors / np.sqrt(np.maximum(eigenvalues, 1.0))
    root[known] = 0.0
    return np.asarray(root)


def _price_of_states(fitted: Fit, window: int) -> float:
    """What the window's uncertain states of effects have taken of their prior: c^2 + log det(1 + information of c)."""
    part, own = fitted.parts[window], fitted.unknowns.own[window]
    of_motion = 2 * fitted.simulator.model.n_joints
    motion, states = part.by_own[:, :of_motion], part.by_own[:, of_motion:]
    if not states.size:
        return 0.0
    alone = states - motion @ np.linalg.lstsq(motion, states)[0]
    spread = fitted.unknowns.own_spread[window][of_motion:]
    information = np.eye(spread.size) + weight_of(part) * (alone * spread).T @ (alone * spread)
    return float(np.sum((own[of_motion:] / spread) ** 2) + np.linalg.slogdet(information)[1])


def _groups(fitted: Fit) -> list[list[int]]:
    """Numbers of the windows that are held out together."""
    runs, at = [], 0
    for run in fitted.runs:
        runs.append(list(range(at, at + len(run.rows))))
        at += len(run.rows)
    if len(runs) > 1:
        return runs
    return [list(map(int, piece)) for piece in np.array_split(runs[0], min(4, len(runs[0])))]


def _predicted(errors: Array, uncertain: Array) -> float:
    """Misfit of errors (m,) of variance 1, and of ``uncertain`` (m, k) times k unknowns of variance 1 besides."""
    beside = np.eye(uncertain.shape[1]) + uncertain.T @ uncertain
    pull = uncertain.T @ errors
    square = float(errors @ errors - pull @ np.linalg.solve(beside, pull))
    return misfit(square, errors.size) + float(np.linalg.slogdet(beside)[1])
