"""Coupling of the sections by their cables (thesis 2.2.3; tangle and untangle of Jones and Walker 2006).

Cables of a distal section pass through every section before it at their own radius and azimuth, straight along the
arm: seen from a proximal section their azimuth is turned by the twists between. Pulling one section so moves the rest.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.cables import (
    cable_jacobian,
    cable_lengths,
    configuration_cable_jacobian,
    configuration_from_cables,
)


@dataclass(frozen=True)
class Routing:
    """Cables through one section: its own actuating cables first, then those that pass, by section.

    Attributes:
        names: names of the cables.
        a: radii of their holes (n_cables,) [m].
        azimuths: their azimuths in this section's frame (n_cables,) [rad].
    """

    names: tuple[str, ...]
    a: Array
    azimuths: Array


def cables_through(arm: Arm, index: int) -> Routing:
    """The cables that run through section ``index`` (0 at the base) of the arm."""
    names: list[str] = []
    radii: list[Array] = []
    azimuths: list[Array] = []
    turn = 0.0
    for k, section in enumerate(arm.sections[index:]):
        turn += section.twist if k else 0.0
        names += section.cable_names
        radii.append(np.full(len(section.cable_azimuths), section.a))
        azimuths.append(np.asarray(section.cable_azimuths) + turn)
    return Routing(tuple(names), np.concatenate(radii), np.concatenate(azimuths))


def section_lengths(w: Array, arm: Arm, index: int) -> Array:
    """Lengths (..., n_cables through it) [m] within section ``index`` at its configuration ``w`` (..., 2) [rad]."""
    routing = cables_through(arm, index)
    return cable_lengths(w, arm.sections[index], routing.a, routing.azimuths)


def section_length_rates(w: Array, w_rate: Array, arm: Arm, index: int) -> Array:
    """Rates (..., n_cables through it) [m/s] within section ``index`` at ``w`` [rad] moving at ``w_rate`` [rad/s]."""
    routing = cables_through(arm, index)
    return _apply(cable_jacobian(w, arm.sections[index], routing.a, routing.azimuths), w_rate)


def tangle(w: Array, arm: Arm) -> Array:
    """Total lengths (..., n_cables of the arm) [m], base to anchor, at ``w`` (..., n_sections, 2) [rad]."""
    parts = [section_lengths(w[..., i, :], arm, i) for i in range(arm.n_sections)]
    return _sum_over_sections(parts, arm)


def tangle_rates(w: Array, w_rate: Array, arm: Arm) -> Array:
    """Rates of the total lengths (..., n_cables of the arm) [m/s], at ``w`` [rad] moving at ``w_rate`` [rad/s]."""
    parts = [section_length_rates(w[..., i, :], w_rate[..., i, :], arm, i) for i in range(arm.n_sections)]
    return _sum_over_sections(parts, arm)


def untangle(totals: Array, arm: Arm) -> Array:
    """Configurations (..., n_sections, 2) [rad] from the total lengths (..., n_cables of the arm) [m].

    The first section's cables belong to it alone and give its configuration; that gives what the others spend in it;
    taken off, the second section's cables are its own; and so on to the tip.
    """
    left = np.array(totals, dtype=float)
    configurations = []
    for i, section in enumerate(arm.sections):
        own = left[..., : len(section.cable_azimuths)]
        configurations.append(configuration_from_cables(own, section))
        spent = section_lengths(configurations[-1], arm, i)
        left = (left - spent)[..., len(section.cable_azimuths) :]
    return np.stack(configurations, axis=-2)


def untangle_rates(totals: Array, total_rates: Array, arm: Arm) -> Array:
    """Rates (..., n_sections, 2) [rad/s] of the configurations, from total lengths [m] and their rates [m/s]."""
    left, left_rates = np.array(totals, dtype=float), np.array(total_rates, dtype=float)
    rates = []
    for i, section in enumerate(arm.sections):
        n_own = len(section.cable_azimuths)
        w = configuration_from_cables(left[..., :n_own], section)
        rates.append(_apply(configuration_cable_jacobian(left[..., :n_own], section), left_rates[..., :n_own]))
        left = (left - section_lengths(w, arm, i))[..., n_own:]
        left_rates = (left_rates - section_length_rates(w, rates[-1], arm, i))[..., n_own:]
    return np.stack(rates, axis=-2)


def _sum_over_sections(parts: list[Array], arm: Arm) -> Array:
    """Sum what the cables spend in every section; a section's part misses the cables that end before it."""
    totals = parts[0].copy()
    first = 0
    for section, part in zip(arm.sections, parts[1:], strict=False):
        first += len(section.cable_azimuths)
        totals[..., first:] += part
    return totals


def _apply(jacobian: Array, rate: Array) -> Array:
    return (jacobian @ rate[..., None])[..., 0]
