"""What a joint passes on: weight, what keeps its load on a curved way, the pull of cables that press it together."""

from __future__ import annotations

import numpy as np

from continuum.dynamics.expressions import Numbers, positive_part, suffix_sum
from continuum.dynamics.planar.eq15_tension_propagation import tension_propagation
from continuum.dynamics.planar.instant import Instant
from continuum.effects.parts.links import along, sum_before


def joint_force(now: Instant) -> Numbers:
    """Force of what lies before each joint on what lies beyond it, (n, 2) in (x, z) [N]; accelerations as 0."""
    move, p = now.motion, now.p
    phi, turning = move.link_angle, (move.link_rate**2)[:, None] * along(move.link_angle)
    inwards = sum_before(p.joint_spacing[:, None] * turning) + p.center_of_mass[:, None] * turning
    down = p.gravity * np.concatenate([-np.sin(p.hang_angle), np.cos(p.hang_angle)])
    of_mass = -suffix_sum(p.mass[:, None] * (inwards + down))
    if not p.has_cables:
        return of_mass
    pull = (tension_propagation(move.theta, move.slip_rate, p) * positive_part(now.u)).sum(axis=1)
    return pull[:, None] * along(phi - move.theta / 2) + of_mass
