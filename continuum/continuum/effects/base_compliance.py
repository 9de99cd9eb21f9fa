"""The base plate rotates on its mount: by psi about its centre, b_1 above joint 1 (at joint 1 without discs).

With the compliance e of the mount, and the frequency w_0 and damping ratio zeta of the plate alone on it,

  psi'' / w_0^2 + 2 zeta psi' / w_0 + psi + e Q_0 = 0,      psi' = its rate,

Q_0 being the moment of the moving arm about the centre of the plate. A massless link 0 of length d_0 = b_1 precedes the
chain, with the coupling A_0j = d_0 (m_j c_j + d_j sum of the masses beyond) and A_00 = d_0^2 (sum of masses).

The cables are anchored on the plate and the springs are between links, so neither acts on psi. The plate has no sensor:
the angle of joint 1 is measured from the unloaded position of the plate, so it is the sum of the joint's angle and psi.
The air drag of `quadratic_drag` includes the rotation of the plate, but not the accompanying sideways motion of joint 1
(psi' b_1).

A bench of 25 N m/rad (e = 0.04 rad/(N m)) yields by 2.5 degrees to the 1.1 N m of the horizontal arm. A plate of 1 kg
and 100 mm, 0.003 kg m^2, oscillates on it at 90 rad/s.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers, suffix_sum
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.balance import link_torque
from continuum.dynamics.planar.instant import Instant, Motion
from continuum.dynamics.planar.rigid_body import link_gravity_torque, mass_moments

_SETTLED = 1e-13  # steps of Newton's method below this size [rad] are rounding errors


class BaseCompliance(Effect):
    """A spring and a damper under the base plate."""

    name = "base_compliance"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "compliance": Parameter("e", "rad/(N m)", 0.0, 2.0, False, "rotation of the base plate per moment", 0.0, 0.04),
        "frequency": Parameter(
            "w_0", "rad/s", 20.0, 1e3, False, "natural frequency of the plate alone on its mount", 100.0, 30.0
        ),
        "damping": Parameter("zeta", "1", 0.01, 2.0, False, "damping ratio of the plate alone on its mount", 0.1, 0.1),
    }
    source = "Lew and Moon, IEEE/ASME Trans. Mechatronics 6, 2001 (manipulators on compliant bases)"
    in_words = "The mount of the base plate yields when the arm swings."
    symptom = "A second, faster oscillation rides on the first at all joints; rest angles hardly change."
    experiment = "Put a sensor on the base plate, or brace the plate, and release again."
    state_sd = 0.01
    beginnings: ClassVar[Sequence[Mapping[str, float]]] = [
        {"compliance": compliance, "frequency": frequency}
        for compliance in (0.012, 0.04, 0.12)
        for frequency in (40.0, 100.0)
    ]

    def n_states(self, n_joints: int) -> int:
        """psi [rad] and its rate [rad/s]."""
        return 2

    def move_base(self, motion: Motion, params: EffectParams, state: Numbers, state_rate: Numbers) -> Motion:
        return replace(
            motion,
            theta=_with_first_reduced(motion.theta, state[:1]),
            theta_rate=_with_first_reduced(motion.theta_rate, state[1:]),
            theta_acceleration=_with_first_reduced(motion.theta_acceleration, state_rate[1:]),
            base_angle=motion.base_angle + state[:1],
            base_rate=motion.base_rate + state[1:],
            base_acceleration=motion.base_acceleration + state_rate[1:],
        )

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """Return the inertial torque of the links due to the motion of joint 1 with the plate, (n,) [N m]."""
        move, lean = now.motion, _lean(now.motion)
        pushed = np.cos(lean) * move.base_acceleration + np.sin(lean) * move.base_rate**2
        return suffix_sum(_lever(now.p) * mass_moments(now.p) * pushed)

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        angle, rate, w = state[:1], state[1:], params["frequency"]
        moved = state_rate[1:] / w**2 + 2 * params["damping"] * rate / w + angle
        moment = self._moment(now, params, state)
        return np.concatenate([state_rate[:1] - rate, moved + params["compliance"] * moment])

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        """Return the states of a plate at rest under the weight of the resting arm."""
        psi, of_links = 0.0, float(np.sum(link_gravity_torque(np.cumsum(theta), p)))
        compliance, weight = params["compliance"].item(), (p.gravity * _first_moment(p)).item()
        for _ in range(20):  # Newton's method; the moment changes by less than its size when the plate turns a radian
            leaning = p.hang_angle.item() + psi
            derivative = 1 + compliance * weight * np.cos(leaning)
            step = (psi + compliance * (of_links + weight * np.sin(leaning))) / derivative
            psi -= step
            if abs(step) < _SETTLED:
                break
        return np.append(psi, 0.0)

    def _moment(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """Q_0, (1,) [N m]."""
        move, p, lean = now.motion, now.p, _lean(now.motion)
        beyond = mass_moments(p) * (np.cos(lean) * move.link_acceleration - np.sin(lean) * move.link_rate**2)
        of_joint_1 = _first_moment(p) * move.base_acceleration + beyond.sum(keepdims=True)
        on_joints = link_torque(now)[:1] + self.torque(now, params, state)[:1]
        return on_joints + _lever(p) * of_joint_1 + _hanging(move.base_angle, p)


def _with_first_reduced(joints: Numbers, by: Numbers) -> Numbers:
    """Return joint values with ``by`` subtracted from the first, (n,)."""
    return joints - np.concatenate([by, np.zeros(joints.size - 1)])


def _lean(move: Motion) -> Numbers:
    """Angle of each link relative to the plate, (n,) [rad]."""
    return move.link_angle - move.base_angle


def _lever(p: Parameters) -> Numbers:
    """d_0: distance from the centre of the plate to joint 1, (1,) [m]."""
    return p.mount


def _first_moment(p: Parameters) -> Numbers:
    """First moment about the centre of the plate of all mass, concentrated at joint 1, (1,) [kg m]."""
    return _lever(p) * p.mass.sum(keepdims=True)


def _hanging(psi: Numbers, p: Parameters) -> Numbers:
    """Moment about the centre of the plate of the weight of the arm, acting at joint 1, (1,) [N m]."""
    return p.gravity * _first_moment(p) * np.sin(p.hang_angle + psi)
