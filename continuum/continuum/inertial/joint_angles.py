"""Joints from links: the difference of neighbours; the first link's neighbour is the base, which stands still."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array


def of_neighbours(links: Array) -> Array:
    """Angles or rates of the joints from those of the links, (..., n): theta_i = alpha_i - alpha_(i-1)."""
    return np.asarray(np.diff(links, axis=-1, prepend=0.0))


def within_half_a_turn(angles: Array) -> Array:
    """The same angles in [-pi, pi) [rad]."""
    return np.asarray((angles + np.pi) % (2 * np.pi) - np.pi)


def with_neighbour(errors: Array) -> Array:
    """Errors of the joints' angles from independent ones of the links', (n,) [rad]."""
    before = np.concatenate([[0.0], errors[:-1]])
    return np.asarray(np.hypot(errors, before))
