"""Use of the redundancy: of all answers to a target near one, that which is nearest to a reference configuration.

The reference is the configuration that the search began with, or the straight arm, whose neighbour bends least.
"""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.kinematics.compiled.arm_arrays import ArmArrays
from continuum.kinematics.compiled.descent import descend
from continuum.kinematics.compiled.equations import compiled
from continuum.kinematics.compiled.least_squares_step import least_squares_step
from continuum.kinematics.compiled.limits import hold_outward, stop_radial
from continuum.kinematics.compiled.task import TargetArrays, evaluate

_MAX_ITERATIONS = 100
_SETTLED = 1e-9  # change of a coordinate that ends the slide [rad]
_CORRECTION_ITERATIONS = 10
_EXACT = 1e-13  # distance [m] and angle [rad] that corrections aim at: slack in the target would pass for a gain
_ROUNDING = 1e-14


@compiled
def slide_towards(arm: ArmArrays, target: TargetArrays, w: Array, reference: Array, tolerance: float) -> int:
    """Move ``w`` (2 n_sections,) [rad], which solves the target, in place towards ``reference``; iterations.

    Each step is the shortest way to the reference within the linearised target, min |dw - (reference - w)| with
    J dw = error, corrected onto the target; it is shortened until the distance to the reference shrinks.
    """
    size = len(w)
    if target.n_rows >= size:
        return 0
    error, jacobian = np.empty(target.n_rows), np.empty((6, size))
    normal, correction = np.empty((size, size)), np.empty(size)
    held = np.empty(len(arm.b), np.bool_)
    descend(arm, target, w, _EXACT, _CORRECTION_ITERATIONS, 0.0)
    remaining = np.sum((w - reference) ** 2)
    gain = 1.0
    for iteration in range(_MAX_ITERATIONS):
        evaluate(arm, target, w, error, jacobian)
        wish = gain * (reference - w)
        held[:] = False
        while True:
            needed = error - jacobian[: target.n_rows] @ wish
            least_squares_step(jacobian, needed, _ROUNDING, normal, correction)
            step = wish + correction
            if not hold_outward(arm, w, step, held, jacobian, target.n_rows):
                break
            stop_radial(w, held, wish)
        trial = w + step
        _, distance, angle, _ = descend(arm, target, trial, _EXACT, _CORRECTION_ITERATIONS, 0.0)
        left = np.sum((trial - reference) ** 2)
        if distance <= tolerance and angle <= tolerance and left < remaining:
            moved = np.max(np.abs(trial - w))
            w[:] = trial
            remaining = left
            gain = min(1.0, 2.0 * gain)
            if moved < _SETTLED:
                return iteration + 1
        else:
            gain *= 0.25
            if gain < 1e-4:
                return iteration + 1
    return _MAX_ITERATIONS
