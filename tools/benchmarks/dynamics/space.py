"""Arms in space: steps a second beside MuJoCo's, the error of a step of 1 ms, the time of sensitivities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import mujoco
import numpy as np
from spatial_arms import equal_sections, in_mujoco

from continuum.arrays import Array
from continuum.dynamics.spatial import sensitivities as by
from continuum.dynamics.spatial.cable_paths import Cables
from continuum.dynamics.spatial.chain import Chain
from continuum.dynamics.spatial.sensitivities import Free, Tangent, simulate_tangent
from continuum.dynamics.spatial.time_stepping import COMPLETE, Joints, initial_state, simulate
from tools.benchmarks.dynamics.scene import cpu_time
from tools.benchmarks.record import Figure, Table

STEP = 1e-3  # s
SECONDS = 0.5  # simulated
FREE = 40  # values by which to differentiate
ARMS = {"one section": (1, 5, 2), "three sections": (3, 5, 2), "three sections, torsion": (3, 5, 3),
        "nine sections": (9, 5, 2)}  # fmt: skip
"""Sections, joints of each, degrees of freedom of a joint."""


class Arm(NamedTuple):
    """An arm of equal sections that three cables each pull, at the start of its motion."""

    chain: Chain
    joints: Joints
    cables: Cables
    q: Array
    tension: Array


@dataclass(frozen=True)
class InSpace:
    """Measurements of one arm.

    Attributes:
        name: its name.
        n: degrees of freedom.
        rate: steps a second with joint friction, and with capstan friction at every disc.
        mujoco: steps a second of MuJoCo with the same joint friction, without capstan friction.
        mujoco_smooth: the same without any friction.
        error: largest difference of an angle to a hundredth of the step, with all friction [deg].
        error_smooth: the same without dry friction of joints and cables [deg].
        apart: largest difference of an angle to MuJoCo's at a tenth of the step, without dry friction [deg].
        sensitivities: time with 40 sensitivities over that without.
    """

    name: str
    n: int
    rate: float
    mujoco: float
    mujoco_smooth: float
    error: float
    error_smooth: float
    apart: float
    sensitivities: float


def measure(repeats: int, names: Sequence[str] = tuple(ARMS)) -> list[InSpace]:
    """Measure the arms by name."""
    return [_measure(name, _arm(*ARMS[name]), repeats) for name in names]


def table(found: Sequence[InSpace]) -> Table:
    """Return the measurements as a table."""
    heading = ("arm", "freedom", "steps a second", "real time", "MuJoCo, frictionloss", "MuJoCo, smooth",
               "times as fast", "error [deg]", "smooth [deg]", "MuJoCo [deg]", "40 derivatives")  # fmt: skip
    return Table.of(
        heading,
        [
            (
                one.name, one.n, f"{one.rate:,.0f}", f"{one.rate * STEP:.0f} x", f"{one.mujoco:,.0f}",
                f"{one.mujoco_smooth:,.0f}", f"{one.rate / one.mujoco:.1f}", f"{one.error:.3f}",
                f"{one.error_smooth:.4f}", f"{one.apart:.4f}", f"{one.sensitivities:.1f} x",
            )
            for one in found
        ],
    )  # fmt: skip


def figures(found: Sequence[InSpace]) -> list[Figure]:
    """Return the figures with their goals."""
    least = min(found, key=lambda one: one.rate / one.mujoco)
    return [
        Figure(f"arms in space, times as fast as MuJoCo: {least.name}", least.rate / least.mujoco, at_least=2.5),
        Figure("arms in space: farthest from MuJoCo, without dry friction", max(one.apart for one in found), "degrees",
               at_most=0.1),
    ]  # fmt: skip


def _arm(n_sections: int, n_joints: int, per_joint: int) -> Arm:
    rng = np.random.default_rng(1)
    chain, joints, cables = equal_sections(n_sections, n_joints, per_joint, friction=0.2)
    n = chain.mass.size
    return Arm(chain, joints, cables, rng.normal(0.0, 0.1, n), rng.uniform(1.0, 10.0, 3 * n_sections))


def _measure(name: str, arm: Arm, repeats: int) -> InSpace:
    none = np.zeros_like(arm.joints.coulomb)
    smooth = arm._replace(
        joints=arm.joints._replace(coulomb=none), cables=arm.cables._replace(friction=0.0 * arm.cables.friction)
    )
    free_of_friction = smooth._replace(joints=smooth.joints._replace(viscous=none))
    seconds, _ = cpu_time(lambda: run(arm), repeats)
    with_tangent, _ = cpu_time(lambda: run_with_sensitivities(arm), repeats)
    theirs, theirs_smooth = (mujoco_time(one, repeats) for one in (arm, free_of_friction))
    error, error_smooth = (np.degrees(abs(run(one) - run(one, STEP / 100)).max()) for one in (arm, smooth))
    apart = np.degrees(abs(run(smooth, STEP / 10) - run_mujoco(smooth, STEP / 10)).max())
    steps = SECONDS / STEP
    return InSpace(
        name, arm.q.size, steps / seconds, steps / theirs, steps / theirs_smooth, error, error_smooth, apart,
        with_tangent / seconds,
    )  # fmt: skip


def run(arm: Arm, step: float = STEP) -> Array:
    """Return the angles at the end, (n,) [rad]."""
    n, q, v = arm.q.size, *np.empty((2, 1, arm.q.size))
    state, holds = initial_state(arm.joints, arm.q, np.zeros(n)), np.zeros(arm.tension.size, bool)
    at, drives = np.array([SECONDS]), np.zeros((1, n))
    tension, steps = arm.tension[None], np.array([round(SECONDS / step)])
    status, _ = simulate(
        arm.chain, arm.joints, arm.cables, holds, state, at, steps, tension, tension, drives, drives, q, v
    )
    if status != COMPLETE:
        raise RuntimeError(f"no simulation of {n} degrees of freedom: status {status}")
    return q[0]


def run_with_sensitivities(arm: Arm) -> Array:
    """Return the derivatives of the angles at the end by 40 values, (n, 40)."""
    n, q, v = arm.q.size, *np.empty((2, 1, arm.q.size))
    kinds = np.array([by.STIFFNESS, by.VISCOUS, by.COULOMB, by.ROTOR])
    entries = np.arange(FREE)
    free = Free(kinds[entries % 4], entries // 4 % n, np.zeros(FREE, np.int64), entries, np.ones(FREE))
    tangent = Tangent(*np.zeros((3, n, FREE)))
    state, holds = initial_state(arm.joints, arm.q, np.zeros(n)), np.zeros(arm.tension.size, bool)
    at, drives = np.array([SECONDS]), np.zeros((1, n))
    tension, steps = arm.tension[None], np.array([round(SECONDS / STEP)])
    q_by, v_by = np.zeros((2, 1, n, FREE))
    simulate_tangent(
        arm.chain, arm.joints, arm.cables, holds, free, state, tangent, at, steps, tension, tension, drives, drives,
        q, v, q_by, v_by,
    )  # fmt: skip
    return q_by[0]


def run_mujoco(arm: Arm, step: float = STEP) -> Array:
    """Return MuJoCo's angles at the end, (n,) [rad]."""
    model = in_mujoco(arm.chain, arm.joints, arm.cables, step)
    data = mujoco.MjData(model)
    data.qpos[:], data.ctrl[:] = arm.q, arm.tension
    mujoco.mj_step(model, data, round(SECONDS / step))
    return data.qpos.copy()


def mujoco_time(arm: Arm, repeats: int) -> float:
    """Return the shortest processor time of MuJoCo's steps alone [s]."""
    model = in_mujoco(arm.chain, arm.joints, arm.cables, STEP)
    data = mujoco.MjData(model)

    def once() -> None:
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.ctrl[:] = arm.q, arm.tension
        mujoco.mj_step(model, data, round(SECONDS / STEP))

    return cpu_time(once, repeats)[0]
