"""Starts of fits (multi-start): smoothed motions say little about friction near rest, which decides where fits end."""

from __future__ import annotations

from continuum.discovery.problem import Problem
from continuum.discovery.search import Found
from continuum.discovery.unknowns import Start, Unknowns

AT_REST = (-0.2, 0.3)
"""Starts of Stribeck's torque above the model file's, in dry frictions: a fit converges from within about 0.3."""
FAR_AT_REST = (-0.4, *AT_REST, 0.8)
"""The same for a fit without others to start from, from no break-away torque to twice the Coulomb friction."""


def as_given(problem: Problem, found: Found) -> Start:
    """Return the values of the model file."""
    return {one.key: 0.0 for one in Unknowns(problem, found, {}).common if one.hypothesis is None}


def at_rest(problem: Problem, found: Found, rise: float) -> Start:
    """Return friction near rest, with Stribeck's torque raised by so much above the model file's."""
    begin = {"stribeck": rise, "speed": 0.0}
    unknowns = Unknowns(problem, found, {}).common
    return {one.key: begin[name] for one in unknowns for effect, name, _ in one.places if not effect and name in begin}
