"""Friction as steep as Coulomb's: a smoother sign creeps where an arm rests."""

from __future__ import annotations

from dataclasses import replace

from continuum.dynamics.model import Model

DRY_SLOPE, CABLE_SLOPE = 1000.0, 2e4
"""Slopes k_v [s/rad] and k_l [s/m] at which smoothed friction can no longer be told from Coulomb's."""


def with_dry_friction(model: Model) -> Model:
    """The model with both slopes at least that steep."""
    steep = {"friction_slope": DRY_SLOPE, "cable_slope": CABLE_SLOPE}
    raised = {name: sensitivity for name, sensitivity in steep.items() if sensitivity > float(model.values()[name][0])}
    sources = dict(model.sources) | dict.fromkeys(raised, "so steep that it cannot be told from dry friction")
    return replace(model.with_values(raised), sources=sources)
