"""Does the missing torque go with something: position, direction, speed, tension, load, turns, time, order?

Correlations by ranks, so that few large values do not decide. Their probability by chance respects that neighbouring
windows are alike: what chance gives is seen by turning each run's series against the other by random amounts (Theiler
1992), which leaves both as alike in themselves as they are.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import rankdata

from continuum.arrays import Array
from continuum.discovery.residual_torque import ResidualTorque

_DRAWS = 400
_ROUNDING = 1e-12
_LITTLE = 0.1  # of the missing torque of the joint that misses most: what goes with less hints at nothing
_FEWEST = 8  # windows that tell a joint's torque

_QUICK, _SOON = 0.05, 0.03  # rad/s beyond which a direction is clear; rad after a turn that are soon after it

_LOOKS: dict[str, Callable[[ResidualTorque, int], Array]] = {
    "position": lambda r, j: r.theta[:, j],
    "direction of motion": lambda r, j: _direction(r, j),
    "speed": lambda r, j: r.theta_rate[:, j],
    "speed squared, signed": lambda r, j: r.theta_rate[:, j] * np.abs(r.theta_rate[:, j]),
    "cube of the angle": lambda r, j: r.theta[:, j] ** 3,
    "difference of tensions": lambda r, _: _pull(r)[:, 0] - _pull(r)[:, 1],
    "direction times tension": lambda r, j: _direction(r, j) * _pull(r).sum(axis=1),
    "direction times load": lambda r, j: _direction(r, j) * r.load[:, j],
    "direction soon after a reversal": lambda r, j: np.where(r.way_since_turn[:, j] < _SOON, _direction(r, j), 0.0),
    "position of the whole arm": lambda r, _: r.theta.sum(axis=1),
    "time within the run": lambda r, _: r.times - r.times[0],
}


def _direction(r: ResidualTorque, joint: int) -> Array:
    return np.tanh(r.theta_rate[:, joint] / _QUICK)


def _pull(r: ResidualTorque) -> Array:
    """Tensions, (n_windows, n_cables) [N]; none of a cable that was let go, which a mark below zero stands for."""
    return np.maximum(r.tension, 0.0)


@dataclass(frozen=True)
class StructureTest:
    """One test.

    Attributes:
        joint: from 0.
        against: what the missing torque was compared with.
        correlation: by ranks, -1 to 1.
        p_value: probability of as large a one by chance.
    """

    joint: int
    against: str
    correlation: float
    p_value: float


def structure_tests(residuals: Sequence[ResidualTorque], random: np.random.Generator) -> list[StructureTest]:
    """Joints that miss a torque to speak of against all looks, the surest first; where the data do not tell it, none.

    Args:
        residuals: of every run.
        random: for the turns.
    """
    found = []
    for joint in _joints_that_miss(residuals):
        told = [(r, r.is_told[:, joint]) for r in residuals if np.any(r.is_told[:, joint])]
        torque = [r.torque[rows, joint] for r, rows in told]
        for against, look in _LOOKS.items():
            other = [look(r, joint)[rows] for r, rows in told]
            if np.std(np.concatenate(other)) < 1e-9:
                continue
            found.append(_tested(joint, against, torque, other, random))
        if len(told) > 2:
            order = [np.full(series.size, float(i)) for i, series in enumerate(torque)]
            found.append(_tested(joint, "order of the runs", torque, order, random))
    return sorted(found, key=lambda test: (test.p_value, -abs(test.correlation)))


def _joints_that_miss(residuals: Sequence[ResidualTorque]) -> list[int]:
    """Joints whose missing torque is told often enough, and is not little beside another's."""
    sizes = []
    for joint in range(residuals[0].torque.shape[1]):
        told = np.concatenate([r.torque[r.is_told[:, joint], joint] for r in residuals])
        sizes.append(float(np.sqrt(np.mean(told**2))) if told.size >= _FEWEST else 0.0)
    return [joint for joint, size in enumerate(sizes) if size > _LITTLE * max(sizes)]


def _tested(
    joint: int, against: str, torque: Sequence[Array], other: Sequence[Array], random: np.random.Generator
) -> StructureTest:
    x, y = _unit_ranks(torque), _unit_ranks(other)
    ranks = np.concatenate(y)
    found = float(np.concatenate(x) @ ranks)
    draws = np.empty(_DRAWS)
    for i in range(_DRAWS):
        turned = [np.roll(series, random.integers(series.size)) for series in x]
        if against == "order of the runs":
            turned = [turned[k] for k in random.permutation(len(turned))]
        draws[i] = np.concatenate(turned) @ ranks
    p_value = (1 + np.sum(np.abs(draws) >= abs(found) - _ROUNDING)) / (1 + _DRAWS)
    return StructureTest(joint, against, found, float(p_value))


def _unit_ranks(series: Sequence[Array]) -> list[Array]:
    """Ranks of all runs' values together, run by run, less their mean and of unit length; 0 where all are alike."""
    ranks = rankdata(np.concatenate(series))
    away = ranks - ranks.mean()
    size = float(np.linalg.norm(away))
    return np.split(away / size if size > 0 else away, np.cumsum([one.size for one in series])[:-1])
