"""Coupling of the sections by their cables (thesis 2.2.3; tangle and untangle of Jones and Walker 2006).

Cables of a distal section pass through every proximal section at their own radius and azimuth, straight along the arm.
Seen from a proximal section, their azimuth is rotated by the twists in between. Pulling one section therefore moves the
others.
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
    """Cables through one section: its actuating cables first, then those of the sections further out, in their order.

    Attributes:
        names: names of the cables.
        a: radii of their holes (n_cables,) [m].
        azimuths: their azimuths in this section's frame (n_cables,) [rad].
    """

    names: tuple[str, ...]
    a: Array
    azimuths: Array


def cables_through(arm: Arm, index: int) -> Routing:
    """Return the cables that run through section ``index`` (0 at the base) of the arm."""
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
    """Return the lengths (..., n_cables) [m] of all cables within section ``index`` at ``w`` (..., 2) [rad]."""
    routing = cables_through(arm, index)
    return cable_lengths(w, arm.sections[index], routing.a, routing.azimuths)


def section_length_rates(w: Array, w_rate: Array, arm: Arm, index: int) -> Array:
    """Return the length rates (..., n_cables) [m/s] within section ``index`` at ``w`` [rad] and ``w_rate`` [rad/s]."""
    routing = cables_through(arm, index)
    return _apply(cable_jacobian(w, arm.sections[index], routing.a, routing.azimuths), w_rate)


@dataclass(frozen=True)
class ArmRouting:
    """All cables in all sections, (n_sections, n_cables); zero where a cable ends before the section.

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
    """Return the routing of a whole arm; cached, because streams of messages need it repeatedly."""
    b, a, azimuths = np.zeros((3, arm.n_sections, len(arm.cable_names)))
    for i, section in enumerate(arm.sections):
        routing = cables_through(arm, i)
        n = len(routing.names)
        b[i, -n:], a[i, -n:], azimuths[i, -n:] = section.b, routing.a, routing.azimuths
    return ArmRouting(b, np.array([[float(section.n_joints)] for section in arm.sections]), a, azimuths)


def tangle(w: Array, arm: Arm) -> Array:
    """Return all total cable lengths (..., n_cables) [m], base to anchor, at ``w`` (..., n_sections, 2) [rad]."""
    routing = arm_routing(arm)
    totals: Array = chords(w, routing.b, routing.n_joints, routing.a, routing.azimuths).sum(axis=-2)
    return totals


def tangle_jacobian(w: Array, arm: Arm) -> Array:
    """Return the jacobian of the total lengths, (..., n_cables, 2 n_sections) [m/rad], at ``w`` (..., n_sections, 2).

    Columns: u, v of section 1, of section 2, ... A cable that ends before a section does not depend on it.
    """
    routing = arm_routing(arm)
    blocks = np.moveaxis(chord_jacobian(w, routing.b, routing.n_joints, routing.a, routing.azimuths), -3, -2)
    return blocks.reshape(*blocks.shape[:-2], -1)


def tangle_rates(w: Array, w_rate: Array, arm: Arm) -> Array:
    """Return the rates of the total lengths (..., n_cables) [m/s] at ``w`` [rad] and ``w_rate`` [rad/s]."""
    return _apply(tangle_jacobian(w, arm), w_rate.reshape(*w_rate.shape[:-2], -1))


def untangle(totals: Array, arm: Arm) -> Array:
    """Return the configurations (..., n_sections, 2) [rad] from all total cable lengths (..., n_cables) [m].

    The cables of the first section run through it alone and give its configuration. That configuration gives the
    lengths of the other cables within the section; they are subtracted, and the procedure continues with the second
    section and so on to the tip.
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
    """Return the configuration rates (..., n_sections, 2) [rad/s] from total lengths [m] and their rates [m/s]."""
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
