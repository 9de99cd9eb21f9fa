"""The same torques by an effect at the other of two joints.

The refitted model has common springs and friction, so two different joints can be described in two ways: the common
value and a factor at one joint, or that joint's value at both and the inverse factor at the other.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.discovery.coordinates import PARAMETER, Coordinates
from continuum.discovery.fit_result import Fitted
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.library import Library
from continuum.discovery.normal_equations import Values
from continuum.discovery.unknowns import linear_unknown

_TWO = 2  # joints, neither of which is the normal one
_SCALES = {
    ("joint_friction", "viscous"): "viscous", ("joint_friction", "coulomb"): "coulomb",
    ("joint_stiffness", "excess"): "stiffness",
}  # fmt: skip
"""Coordinate of the baseline whose parameter an effect's factor multiplies at a joint."""


def mirrored(
    fit: Fitted, one: Hypothesis, library: Library, coordinates: Coordinates
) -> tuple[Hypothesis, Fitted] | None:
    """Return the hypothesis at the other of two joints, and the start of its fit; None if its effect is no such factor.

    Args:
        fit: fit of a set that contains ``one``.
        one: hypothesis at one of two joints.
        library: library with both hypotheses.
        coordinates: coordinates of the baseline.
    """
    kinds = [_SCALES.get((one.effect, c.parameter)) for c in one.coefficients]
    if coordinates.structure.n != _TWO or one.joints is None or len(one.joints) != 1 or None in kinds or not kinds:
        return None
    (joint,) = one.joints
    other = next((h for h in library.hypotheses if h.key == (one.effect, (1 - joint,))), None)
    if other is None or len(other.coefficients) != len(kinds):
        return None
    unknowns, values = list(fit.unknowns.common), fit.values.common.copy()
    factors = {}
    for k, kind in enumerate(kinds):
        at = next(i for i, u in enumerate(unknowns) if u.key == linear_unknown(one, k, library).key)
        factors[kind] = max(1 + float(values[at]), 1e-3)
        unknowns[at], values[at] = linear_unknown(other, k, library), 1 / factors[kind] - 1
    p, slots = coordinates.reference, coordinates.structure.slots
    for at, unknown in enumerate(unknowns):
        effect, kind, place = next(iter(unknown.places))
        if not effect and place < 0 and kind in factors:
            relative = float(np.max(coordinates.steps[kind] / p[slots[PARAMETER[kind]]]))
            values[at] = ((1 + relative * values[at]) * factors[kind] - 1) / relative
    lists = fit.unknowns.with_lists(unknowns, fit.unknowns.per_run)
    return other, replace(fit, unknowns=lists, values=Values(values, fit.values.per_run, fit.values.local))
