"""The comparison of the thesis's chapter 4.3: 90 degrees of total bend by one cable, with mu_c = 0.2.

The arm hangs; cable 1 is pulled slowly from slack, as on the bench, until the joints' angles add up to the bend. The
constant-curvature model bends every joint alike. The dynamic model is shown as it is simulated, its friction lagging
behind, and as statics knows it: the equilibrium with the cable's losses, and what dry friction may add to it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.pulled_posture import pulled_posture
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.statics.equilibrium import Equilibrium, equilibrium
from continuum.dynamics.statics.resting_arm import Load, RestingArm
from continuum.dynamics.statics.sticking_zone import StickingZone, sticking_zone
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus

CAPSTAN_FRICTION = 0.2
TOTAL_BEND = np.pi / 2  # [rad]
_PULL = (30.0, 30.0)  # seconds that the pull takes, and the tension that it ends with [N]


@dataclass(frozen=True)
class Bend:
    """The arm bent by one cable.

    Attributes:
        model: that was bent.
        pulled: joint angles while being pulled, in the moment of the wanted bend, (n,) [rad].
        tension: of the cable then [N].
        resting: the equilibrium with the same bend, the cable having been taken in.
        zone: what dry friction holds around it.
        returning: the equilibrium under the same tension if the cable slid the other way last.
    """

    model: Model
    pulled: Array
    tension: float
    resting: Equilibrium
    zone: StickingZone
    returning: Equilibrium

    @property
    def even(self) -> Array:
        """Joint angles of constant curvature, (n,) [rad]."""
        return np.full(self.pulled.size, self.pulled.sum() / self.pulled.size)


def bend_by_one_cable(total: float = TOTAL_BEND) -> Bend:
    """Pull until the joints' angles add up to ``total`` [rad], > 0."""
    model = load_model("lamecc_prototype.yaml").with_values({"capstan_friction": CAPSTAN_FRICTION})
    seconds, most = _PULL
    pull = Tensions(np.array([0.0, seconds]), np.array([[0.0, 0.0], [most, 0.0]]))
    times = np.linspace(0.0, seconds, 3001)
    run = Simulator(model).run(np.zeros(model.n_joints), times, pull)
    if run.status is not SimulationStatus.COMPLETE:
        raise RuntimeError(f"the slow pull failed: {run.status.value}")
    at = np.interp(total, run.theta.sum(axis=1), times)
    pulled = np.array([np.interp(at, times, joint) for joint in run.theta.T])
    arm, held = RestingArm(model), pulled_posture(model, total)
    resting = equilibrium(arm, Load(held.tension, approach=1), held.theta)
    returning = equilibrium(arm, Load(held.tension, approach=-1), resting.theta)
    return Bend(model, pulled, float(pull.at(float(at))[0]), resting, sticking_zone(arm, resting), returning)


def joint_positions(theta: Array, half_spacing: float) -> Array:
    """Base, joints and tip in the plane of bending, (n + 2, 2) [m]: x towards positive angles, z away from the base."""
    lengths = np.full(theta.size + 1, 2 * half_spacing)
    lengths[[0, -1]] = half_spacing
    angles = np.concatenate([[0.0], np.cumsum(theta)])
    links = lengths[:, None] * np.stack([np.sin(angles), np.cos(angles)], axis=1)
    return np.concatenate([np.zeros((1, 2)), np.cumsum(links, axis=0)])
