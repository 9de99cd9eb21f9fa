"""A planar chain in MuJoCo, an independent engine of rigid bodies."""

import mujoco
import numpy as np

from continuum.dynamics.parameters import Parameters


class Engine:
    """MuJoCo's planar chain with the same links; z along the straight arm, positive angles turn z towards x."""

    def __init__(self, p: Parameters) -> None:
        bodies = ""
        for i in reversed(range(p.n_joints)):
            at = p.joint_spacing[i - 1] if i else 0.0
            inertia = " ".join([f"{p.inertia[i]:.17g}"] * 3)
            bodies = (
                f'<body pos="0 0 {at:.17g}"><joint type="hinge" axis="0 1 0" armature="{p.rotor_inertia[i]:.17g}"/>'
                f'<inertial mass="{p.mass[i]:.17g}" pos="0 0 {p.center_of_mass[i]:.17g}" diaginertia="{inertia}"/>'
                f"{bodies}</body>"
            )
        xml = f'<mujoco><compiler boundinertia="0"/><worldbody>{bodies}</worldbody></mujoco>'
        self.model = mujoco.MjModel.from_xml_string(xml)
        beta = p.hang_angle[0]
        self.model.opt.gravity = p.gravity[0] * np.array([-np.sin(beta), 0.0, np.cos(beta)])
        self.data = mujoco.MjData(self.model)

    def inertia(self, theta: np.ndarray) -> np.ndarray:
        self.bias(theta, 0 * theta)
        M = np.zeros((theta.size, theta.size))
        mujoco.mj_fullM(self.model, self.data, M)
        return M

    def bias(self, theta: np.ndarray, rate: np.ndarray) -> np.ndarray:
        """C theta' + G [N m]."""
        self.acceleration(theta, rate, 0 * theta)
        return self.data.qfrc_bias.copy()

    def acceleration(self, theta: np.ndarray, rate: np.ndarray, torque: np.ndarray) -> np.ndarray:
        """theta'' [rad/s2] under torques at the joints [N m]."""
        self.data.qpos[:], self.data.qvel[:], self.data.qfrc_applied[:] = theta, rate, torque
        mujoco.mj_forward(self.model, self.data)
        return self.data.qacc.copy()
