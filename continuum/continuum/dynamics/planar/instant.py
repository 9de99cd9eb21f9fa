"""Arguments of the terms of Eq. 12 at one instant: motion, cable tensions, joint torques and parameters."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters


@dataclass(frozen=True)
class Motion:
    """Position, speed and acceleration of a planar chain, in relative joint angles and absolute link angles.

    Attributes:
        theta, theta_rate, theta_acceleration: motion of the joints, (n,) [rad, rad/s, rad/s2].
        base_angle, base_rate, base_acceleration: rotation of the base plate, (1,) [rad, rad/s, rad/s2]; zero unless an
            effect rotates it.
    """

    theta: Numbers
    theta_rate: Numbers
    theta_acceleration: Numbers
    base_angle: Numbers
    base_rate: Numbers
    base_acceleration: Numbers

    @property
    def slip_rate(self) -> Numbers:
        """Joint rates in the dry friction terms, (n,) [rad/s]; they differ from ``theta_rate`` in estimators."""
        return self.theta_rate

    @property
    def link_angle(self) -> Numbers:
        """Angle of each link from the straight arm, (n,) [rad]."""
        return self.base_angle + self.summed(self.theta)

    @property
    def link_rate(self) -> Numbers:
        """Rate of each link angle, (n,) [rad/s]."""
        return self.base_rate + self.summed(self.theta_rate)

    @property
    def link_acceleration(self) -> Numbers:
        """Acceleration of each link angle, (n,) [rad/s2]."""
        return self.base_acceleration + self.summed(self.theta_acceleration)

    def summed(self, joints: Numbers) -> Numbers:
        """Return the cumulative sums of joint quantities from the base, (n,)."""
        return np.cumsum(joints)


@dataclass(frozen=True)
class Instant:
    """One instant of the arm, the argument of the equations.

    Attributes:
        motion: motion of joints and links.
        u: tension of each cable at the base, (n_cables,) [N].
        p: parameters.
        drive: torque of the joints' drives, (n,) [N m], or a zero (1,) without drives.
    """

    motion: Motion
    u: Numbers
    p: Parameters
    drive: Numbers = field(default_factory=lambda: np.zeros(1))
