"""Terms of the equations of motion at one instant, for those who do not simulate: M, bias, derivatives, cables."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.spatial.cable_paths import Cables, new_paths, trace
from continuum.dynamics.spatial.chain import (
    Chain,
    derivatives,
    inverse_dynamics,
    mass_matrix,
    new_derivatives,
    new_moving,
    new_placed,
    place,
)
from continuum.dynamics.spatial.compiling import entry_point


@entry_point
def rigid_body_terms(chain: Chain, q: Array, v: Array, a: Array) -> tuple[Array, Array, Array, Array]:
    """Inverse dynamics of a chain, and its derivatives.

    Args:
        chain: the chain.
        q, v, a: angles, rates and accelerations, (n,) [rad, rad/s, rad/s2].

    Returns:
        Torque M a + C v + G, (n,) [N m]; M, (n, n) [kg m2], with rotors; derivatives of the torque by angles and rates,
        (n, n) [N m/rad, N m s/rad].
    """
    n = q.size
    placed, moving, derived = new_placed(n), new_moving(n), new_derivatives(n)
    torque, M = np.empty(n), np.empty((n, n))
    place(chain, q, placed)
    mass_matrix(placed, M)
    for i in range(n):
        M[i, i] += chain.rotor[i]
        for j in range(i):
            M[i, j] = M[j, i]
    inverse_dynamics(chain, placed, v, a, moving, torque)
    derivatives(chain, placed, moving, derived)
    for i in range(n):
        torque[i] += chain.rotor[i] * a[i]
    return torque, M, derived.by_q, derived.by_v


@entry_point
def cable_terms(chain: Chain, cables: Cables, q: Array) -> tuple[Array, Array, Array]:
    """Cables of a chain in a configuration.

    Args:
        chain, cables: the arm.
        q: angles, (n,) [rad].

    Returns:
        Length of each cable, (n_cables,) [m]; its derivative by the angles, (n_cables, n) [m/rad]; angle by which a
        cable that rubs bends at each hole, (n_holes,) [rad].
    """
    placed, paths = new_placed(q.size), new_paths(cables, q.size)
    place(chain, q, placed)
    trace(cables, chain.base, placed, paths)
    lengths = np.zeros(cables.first.size - 1)
    for c in range(lengths.size):
        for k in range(cables.first[c] + 1, cables.first[c + 1]):
            lengths[c] += paths.length[k]
    return lengths, paths.gradient, paths.bend


@entry_point
def body_poses(chain: Chain, q: Array) -> tuple[Array, Array]:
    """Origins (n_times, n, 3) [m] and rotations (n_times, n, 3, 3) of the bodies at angles ``q`` (n_times, n) [rad]."""
    n_times, n = q.shape
    placed = new_placed(n)
    origins, rotations = np.empty((n_times, n, 3)), np.empty((n_times, n, 3, 3))
    for t in range(n_times):
        place(chain, q[t], placed)
        origins[t] = placed.origin
        rotations[t] = placed.rotation
    return origins, rotations
