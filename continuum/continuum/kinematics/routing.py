"""Coupling of the sections by their cables (thesis 2.2.3; tangle and untangle of Jones and Walker 2006).

Cables of a distal section pass through every section before it at their own radius and azimuth, straight along the
arm: seen from a proximal section their azimuth is turned by the twists between. Pulling one section so moves the rest.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.cables import (
    cable_jacobian,
    cable_lengths,
    chord_jacobian,
    chords,
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


@dataclass(frozen=True)
class ArmRouting:
    """All cables in all sections, (n_sections, n_cables); a cable that ends before a section is zero there.

    Attributes:
        b: distance disc to joint [m].
        n_joints: number of joints (n_sections, 1).
        a: radii of the holes [m].
        azimuths: in the section's frame [rad].
    """

    b: Array
    n_joints: Array
    a: Array
    azimuths: Array


@lru_cache
def arm_routing(arm: Arm) -> ArmRouting:
    """The routing of a whole arm; kept, since a stream of messages asks for it again and again."""
    b, a, azimuths = np.zeros((3, arm.n_sections, len(arm.cable_names)))
    for i, section in enumerate(arm.sections):
        routing = cables_through(arm, i)
        n = len(routing.names)
        b[i, -n:], a[i, -n:], azimuths[i, -n:] = section.b, routing.a, routing.azimuths
    return ArmRouting(b, np.array([[float(section.n_joints)] for section in arm.sections]), a, azimuths)


def tangle(w: Array, arm: Arm) -> Array:
    """Total lengths (..., n_cables of the arm) [m], base to anchor, at ``w`` (..., n_sections, 2) [rad]."""
    routing = arm_routing(arm)
    totals: Array = chords(w, routing.b, routing.n_joints, routing.a, routing.azimuths).sum(axis=-2)
    return totals


def tangle_jacobian(w: Array, arm: Arm) -> Array:
    """Slopes of the total lengths, (..., n_cables of the arm, 2 n_sections) [m/rad], at ``w`` (..., n_sections, 2).

    Columns: u, v of section 1, of section 2, ... A cable that ends before a section does not depend on it.
    """
    routing = arm_routing(arm)
    blocks = np.moveaxis(chord_jacobian(w, routing.b, routing.n_joints, routing.a, routing.azimuths), -3, -2)
    return blocks.reshape(*blocks.shape[:-2], -1)


def tangle_rates(w: Array, w_rate: Array, arm: Arm) -> Array:
    """Rates of the total lengths (..., n_cables of the arm) [m/s], at ``w`` [rad] moving at ``w_rate`` [rad/s]."""
    return _apply(tangle_jacobian(w, arm), w_rate.reshape(*w_rate.shape[:-2], -1))


def untangle(totals: Array, arm: Arm) -> Array:
    """Configurations (..., n_sections, 2) [rad] from the total lengths (..., n_cables of the arm) [m].

    The first section's cables belong to it alone and give its configuration; that gives what the others spend in it;
    taken off, the second section's cables are its own; and so on to the tip.
    """
    routing = arm_routing(arm)
    left = np.array(totals, dtype=float)
    configurations, first = [], 0
    for i, section in enumerate(arm.sections):
        after = first + len(section.cable_azimuths)
        configurations.append(configuration_from_cables(left[..., first:after], section))
        left -= chords(configurations[-1], routing.b[i], routing.n_joints[i], routing.a[i], routing.azimuths[i])
        first = after
    return np.stack(configurations, axis=-2)


def untangle_rates(totals: Array, total_rates: Array, arm: Arm) -> Array:
    """Rates (..., n_sections, 2) [rad/s] of the configurations, from total lengths [m] and their rates [m/s]."""
    left, left_rates = np.array(totals, dtype=float), np.array(total_rates, dtype=float)
    rates = []
    for i, section in enumerate(arm.sections):
        n_actuating = len(section.cable_azimuths)
        w = configuration_from_cables(left[..., :n_actuating], section)
        rates.append(
            _apply(configuration_cable_jacobian(left[..., :n_actuating], section), left_rates[..., :n_actuating])
        )
        left = (left - section_lengths(w, arm, i))[..., n_actuating:]
        left_rates = (left_rates - section_length_rates(w, rates[-1], arm, i))[..., n_actuating:]
    return np.stack(rates, axis=-2)


def _apply(jacobian: Array, rate: Array) -> Array:
    return (jacobian @ rate[..., None])[..., 0]
