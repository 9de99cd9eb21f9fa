"""Hypotheses that no recording could tell apart are one.

They change the torque of any motion in proportion to each other: a weight at the tip, say, and more mass of a last link
whose centre of mass is there.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arrays import Array
from continuum.discovery.hypotheses import Hypothesis
from continuum.estimation.columns import Column, Slope

_ROUNDING = 1e-9
"""Part by which two torques may differ, and be the same."""


def distinct(
    hypotheses: Sequence[Hypothesis], columns: Sequence[Column], by_parameters: Array
) -> tuple[list[Hypothesis], dict[str, list[str]]]:
    """One of each that are the same, of the whole arm rather than of a joint; labels of the others by its label.

    Args:
        hypotheses: all.
        columns: that they use.
        by_parameters: derivatives of the torque in motions drawn at random, (rows, n_p).
    """
    kept, same, twins = list[tuple[Hypothesis, Array]](), dict[str, list[str]](), set[Hypothesis]()
    for h in sorted(hypotheses, key=lambda one: one.joints is not None):
        torque = _torque(h, columns, by_parameters)
        if torque is None:
            continue
        twin = next(
            (one for one, other in kept if abs(float(other @ torque)) > 1 - _ROUNDING and one.key != h.key), None
        )
        if twin is None:
            kept.append((h, torque))
        else:
            twins.add(h)
            same.setdefault(twin.label, []).append(h.label)
    return [h for h in hypotheses if h not in twins], same


def _torque(h: Hypothesis, columns: Sequence[Column], by_parameters: Array) -> Array | None:
    """Torque of a hypothesis of one size in those motions, of unit length; None where it is not so simple."""
    if len(h.columns) != 1 or h.local or h.start is not None:
        return None
    direction, at, weights = np.zeros(by_parameters.shape[1]), 0, h.map(sum(column.width for column in columns))[:, 0]
    for column in columns:
        used = weights[at : at + column.width]
        if np.any(used):
            if not isinstance(column, Slope):
                return None
            direction += column.directions @ used
        at += column.width
    torque = by_parameters @ direction
    size = float(np.linalg.norm(torque))
    return torque / size if size > 0 else None
