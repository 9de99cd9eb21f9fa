"""Dry friction of the cables at the discs: a Coulomb law with stiction, not the belt formula.

At disc k a cable turns by phi_k = |theta_k + theta_k+1| / 2 (at the base plate |theta_1| / 2). A cable with the mean
tension T there presses on the hole's edge with N = 2 T sin(phi_k / 2), and mu_c N is the most that the edge can hold,
or what sliding costs. The sliding is that of the cable beyond the disc, so the friction acts on a tendon from disc k
to the tip.
"""

import numba
import numpy as np

LEAST = 1e-9  # friction must be positive for its rows to stay where they are among the constraints [N]


@numba.njit(cache=True)
def friction_limits(angle, pull, force, mu):  # type: ignore[no-untyped-def]
    """Largest friction at each disc (2, 5) [N].

    Args:
        angle: of the joints (5,) [rad].
        pull: tensions at the base (2,) [N].
        force: friction at the discs one step ago (2, 5) [N], positive where it lengthens the cable beyond.
        mu: coefficient of friction.
    """
    limits = np.empty_like(force)
    for cable in range(pull.size):
        tension, before = pull[cable], 0.0
        for disc in range(angle.size):
            turn = abs(before + angle[disc]) / 2
            mean = tension - 0.5 * force[cable, disc]
            limits[cable, disc] = max(2 * mu * np.sin(turn / 2) * mean, LEAST)
            tension, before = tension - force[cable, disc], angle[disc]
    return limits
