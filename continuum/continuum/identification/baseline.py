"""What every fit moves: the thesis's five parameters, and each joint's own within what parts of one batch differ by."""

from __future__ import annotations

from dataclasses import replace

from continuum.dynamics.model import Model
from continuum.identification.fit import THESIS_PARAMETERS
from continuum.identification.free import Free

BATCH = {"stiffness": 0.02, "viscous_friction": 0.03, "coulomb_friction": 0.03, "mass": 0.01, "inertia": 0.03}
"""Standard deviation from part to part, relative: coil springs of one batch keep 2 %, turned and weighed parts 1 %;
moments of inertia are computed, from drawings without screws and glue."""

_BENCH_TEST = 0.03
"""Standard deviation, relative, to which the capstan friction of a cable is known."""

DRY_SLOPE, CABLE_SLOPE = 1000.0, 2e4
"""Slopes k_v [s/rad] and k_l [s/m] at which smoothed friction can no longer be told from Coulomb's."""


def baseline_unknowns(model: Model) -> list[Free]:
    """Unknowns of Eq. 12 itself."""
    common = [*(Free(name) for name in THESIS_PARAMETERS), Free("capstan_friction", tolerance=_BENCH_TEST)]
    return common + [
        Free(name, joint, tolerance=tolerance) for name, tolerance in BATCH.items() for joint in range(model.n_joints)
    ]


def with_dry_friction(model: Model) -> Model:
    """The model with friction as steep as Coulomb's, which sticks; a smoother one creeps where an arm rests."""
    steep = {"friction_slope": DRY_SLOPE, "cable_slope": CABLE_SLOPE}
    raised = {name: slope for name, slope in steep.items() if slope > float(model.values()[name][0])}
    sources = dict(model.sources) | dict.fromkeys(raised, "so steep that it cannot be told from dry friction")
    return replace(model.with_values(raised), sources=sources)
