"""What the terms of Eq. 12 see of an instant: motion, cable tensions, joint torques, and the parameters that hold."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters


@dataclass(frozen=True)
class Motion:
    """Position, speed and acceleration of a planar chain: relative joint angles, and the links' absolute ones.

    Attributes:
        theta, theta_rate, theta_acceleration: of the joints, (n,) [rad, rad/s, rad/s2].
        base_angle, base_rate, base_acceleration: turn of the base plate itself, (1,); zero unless an effect turns it.
    """

    theta: Numbers
    theta_rate: Numbers
    theta_acceleration: Numbers
    base_angle: Numbers
    base_rate: Numbers
    base_acceleration: Numbers

    @property
    def slip_rate(self) -> Numbers:
        """Joint rates as dry friction and its sign see them, (n,) [rad/s]; given while motion is estimated."""
        return self.theta_rate

    @property
    def link_angle(self) -> Numbers:
        """Angle of each link from the straight arm, (n,) [rad]."""
        return self.base_angle + self.summed(self.theta)

    @property
    def link_rate(self) -> Numbers:
        """Its rate, (n,) [rad/s]."""
        return self.base_rate + self.summed(self.theta_rate)

    @property
    def link_acceleration(self) -> Numbers:
        """And acceleration, (n,) [rad/s2]."""
        return self.base_acceleration + self.summed(self.theta_acceleration)

    def summed(self, joints: Numbers) -> Numbers:
        """Sums from the base of what belongs to the joints, (n,)."""
        return np.cumsum(joints)


@dataclass(frozen=True)
class Instant:
    """One instant of the arm, as an equation sees it.

    Attributes:
        motion: of joints and links.
        u: tension of each cable at the base, (n_cables,) [N].
        p: parameters.
        drive: torque of the joints' drives, (n,) [N m], or (1,) where there are none.
    """

    motion: Motion
    u: Numbers
    p: Parameters
    drive: Numbers = field(default_factory=lambda: np.zeros(1))
