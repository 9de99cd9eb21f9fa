"""The comparison of the thesis's chapter 4.3, by the functions of `continuum curvature`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.curvature.answer import Answer, answer
from continuum.curvature.held_posture import HeldPosture, held_posture
from continuum.curvature.holds import hold_at
from continuum.dynamics.statics.resting_arm import RestingArm
from tools.benchmarks.reproduction.release import Release, prototype

TOTAL_BEND = np.pi / 2  # [rad]
FIRST_ROW = slice(0, 1)


@dataclass(frozen=True)
class Curvature:
    """Comparison of an arm bent by one cable.

    Attributes:
        pulled: the dynamic model at Fig. 10's bend, after its cable was taken in.
        returning: the same after the cable was let out.
        simulated, measured: both models compared with the first rows of repetition 7, as if measured at rest.
    """

    pulled: HeldPosture
    returning: HeldPosture
    simulated: Answer
    measured: Answer


def compare_curvature(release: Release) -> Curvature:
    """Compare at Fig. 10's total bend, and at the bends from which repetition 7 was released."""
    model = prototype()
    arm = RestingArm(model)
    pulled, returning = (held_posture(arm, TOTAL_BEND, None, approach) for approach in (1, -1))
    rows = (answer(model, [hold_at(run, FIRST_ROW)]) for run in (release.published, release.measured))
    return Curvature(pulled, returning, *rows)
