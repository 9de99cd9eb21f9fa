"""What recordings would have shown of each effect, in the effect's units, with a reason if they would not."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.power import Power
from continuum.discovery.problem import Problem
from continuum.discovery.result import Detectable
from continuum.languages import Message

_MOSTLY = 0.5
"""Fraction of a change that counts as most of it."""


def detectable(problem: Problem, powers: Sequence[Power]) -> tuple[Detectable, ...]:
    """Return the smallest detectable size of every effect that may act on this arm, the smallest first.

    Args:
        problem: problem with the recordings.
        powers: power of each hypothesis about the best set.
    """
    offered = {effect.name: effect for effect in problem.structure.offered}
    found = []
    for one in powers:
        h = one.hypothesis
        name, spec = next((n, s) for n, s in offered[h.effect].parameters.items() if _is_size(n, h))
        typical = spec.typical or 1.0
        smallest = one.smallest
        found.append(
            Detectable(h.effect, h.joints, name, spec.unit, typical, smallest * typical, _reason(one, smallest))
        )
    for effect in problem.structure.left_out:
        name, spec = next(iter(effect.parameters.items()))
        found.append(
            Detectable(
                effect.name, None, name, spec.unit, spec.typical or 1.0, np.inf,
                Message("Nothing pulls or drives the arm in these recordings."),
            )
        )  # fmt: skip
    return tuple(sorted(found, key=lambda one: (one.smallest / one.typical, one.label)))


def _is_size(name: str, h: Hypothesis) -> bool:
    return not h.coefficients or name == h.coefficients[0].parameter


def _reason(one: Power, smallest: float) -> str:
    if smallest <= 1:
        return ""
    if not one.changes > 0:
        return Message("It changes nothing in these recordings.")
    if one.changes < 1:
        return Message(
            "At its typical size, it changes the readings by only {factor:.2g} times the simulation error.",
            factor=one.changes,
        )
    if one.kept < _MOSTLY:
        taken = 100 * (1 - one.kept)
        return Message(
            "{part:.0f} % of what it changes could also come from springs, friction, masses or sensors' zeros.",
            part=taken,
        )
    return Message("It changes the readings, but acts in too few of them.")
