"""Open-loop runs of models from URDFs, of 1 to 20 joints, are those of MuJoCo with the same URDFs and torques.

The arms start near hanging straight down, with torques that are small compared with their weight. Agreement to 1e-6 rad
is a fair demand only where a motion hardly amplifies errors, and where MuJoCo's own are smaller: both are asserted.
"""

from pathlib import Path

import mujoco
import numpy as np
import pytest
from test_urdf_chain import planar_arm, read

from continuum.dynamics.integration.esdirk_tableau import fourth_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.urdf_chain import UrdfChain

TIGHT = Tolerances(1e-9, 1e-10, 0.01)
AGREEMENT = 1e-6  # rad
STEP = 1.25e-4  # of MuJoCo's Runge-Kutta method of order 4 [s]
ORDER = 4
AMPLIFIED = 20.0  # at most: beyond it, agreement would take states to better than 5e-8


def torques(n: int, *, held: bool) -> JointTorques:
    """Random rows at 20 Hz over a second, the larger the nearer the base."""
    size = 0.3 * np.arange(n, 0, -1)
    return JointTorques(np.linspace(0.0, 1.0, 21), np.random.default_rng([1, n]).uniform(-size, size, (21, n)), held)


def start(chain: UrdfChain) -> np.ndarray:
    """Angles and rates of the model near the plumb line, (2 n,) [rad, rad/s]."""
    n = chain.model.n_joints
    random = np.random.default_rng([2, n])
    x = np.concatenate([random.uniform(-0.3, 0.3, n), random.uniform(-0.5, 0.5, n)])
    x[0] -= chain.model.parameters.hang_angle[0]
    return x


def in_mujoco(text: str, chain: UrdfChain, x: np.ndarray, drive: JointTorques, step: float) -> np.ndarray:
    """Angles of the model at the rows of torques, (rows, n) [rad], where MuJoCo moves the URDF's joints."""
    engine, n = mujoco.MjModel.from_xml_string(text), chain.model.n_joints
    engine.opt.integrator, engine.opt.timestep = mujoco.mjtIntegrator.mjINT_RK4, step
    engine.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT  # a model has no limits of joints
    data, found = mujoco.MjData(engine), [x[:n]]
    data.qpos[:], data.qvel[:] = chain.signs * (x[:n] - chain.zeros), chain.signs * x[n:]
    torque, slope, begin = chain.signs * drive.values, 0.0, 0.0

    def act(_: mujoco.MjModel, now: mujoco.MjData) -> None:
        """Called at every stage of a step."""
        now.qfrc_applied[:] = row + (now.time - begin) * slope

    mujoco.set_mjcb_control(act)
    try:
        for row, following, begin, end in zip(torque, torque[1:], drive.times, drive.times[1:], strict=False):
            slope = 0.0 if drive.held else (following - row) / (end - begin)
            mujoco.mj_step(engine, data, round((end - begin) / step))
            found.append(chain.signs * data.qpos + chain.zeros)
    finally:
        mujoco.set_mjcb_control(None)
    return np.array(found)


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("n", [1, 2, 7, pytest.param(20, marks=pytest.mark.slow)])
def test_a_second_of_a_urdfs_motion_is_that_of_mujoco(n: int, held: bool, tmp_path: Path) -> None:
    text, drive = planar_arm(n, n), torques(n, held=held)
    chain = read(text, tmp_path)
    simulator, x = Simulator(chain.model, TIGHT, fourth_order()), start(chain)
    found = simulator.run(x, drive.times, drive)
    assert found.status is SimulationStatus.COMPLETE
    assert np.ptp(found.theta, axis=0).min() > 0.1
    coarse, fine = (in_mujoco(text, chain, x, drive, step) for step in (2 * STEP, STEP))
    assert np.abs(coarse - fine).max() / (2**ORDER - 1) < AGREEMENT / 10
    np.testing.assert_allclose(found.theta, fine, rtol=0, atol=AGREEMENT)
    aside = np.random.default_rng(n).normal(size=(2 * n, 3))
    for one in 1e-4 * (aside / np.linalg.norm(aside, axis=0)).T:
        nearby = simulator.run(x + one, drive.times, drive)
        assert np.linalg.norm(nearby.theta - found.theta, axis=1).max() < AMPLIFIED * np.linalg.norm(one)
