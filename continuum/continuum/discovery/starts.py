"""Where fits begin (multi-start): a smoothed motion tells little of friction near rest, which decides where it ends."""

from __future__ import annotations

from continuum.discovery.problem import Problem
from continuum.discovery.search import Found
from continuum.discovery.unknowns import Start, Unknowns

AT_REST = (-0.2, 0.3)
"""Where Stribeck's torque begins, in dry frictions above the model file's: a fit finds it from within some 0.3."""
FAR_AT_REST = (-0.4, *AT_REST, 0.8)
"""The same where a fit must find it alone, from no break-away torque to twice the Coulomb friction."""


def as_given(problem: Problem, found: Found) -> Start:
    """The model file's own values."""
    return {one.key: 0.0 for one in Unknowns(problem, found, {}).common if one.hypothesis is None}


def at_rest(problem: Problem, found: Found, rise: float) -> Start:
    """Friction near rest, Stribeck's torque by so much above the model file's."""
    begin = {"stribeck": rise, "speed": 0.0}
    unknowns = Unknowns(problem, found, {}).common
    return {one.key: begin[name] for one in unknowns for effect, name, _ in one.places if not effect and name in begin}
