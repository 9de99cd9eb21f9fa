"""Beyond the thesis, in M of Eq. 12: inertia of the joints' drives, J_r theta''.

A drive is taken to turn with its joint: its rotor's inertia, times the gear ratio squared, at the joint's own, relative
acceleration. That the rotor also turns with the link that carries it is left out, a part of 1 / (gear ratio) of this.
"""

from __future__ import annotations

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters


def rotor_torque(theta_acceleration: Numbers, p: Parameters) -> Numbers:
    """J_r theta'', (n,) [N m], of joint accelerations (n,) [rad/s2]."""
    return p.rotor_inertia * theta_acceleration
