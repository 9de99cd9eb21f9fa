"""A planar arm of three joints as a URDF, and its simulation by MuJoCo with a payload that the URDF lacks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np

from continuum.arrays import Array

JOINTS: Final = ("shoulder", "elbow", "wrist")
RATE = 120  # rows a second
SUBSTEPS = 128  # integrator steps per row: with 256, angles differ by 0.005 degrees at most
RADIUS = 0.01  # of the payload, a ball [m]
_HARD: Final = (0.9999, 0.9999, 0.001, 0.5, 2.0)  # impedance of dry friction: a held joint creeps by some 1e-5 rad/s


@dataclass(frozen=True)
class _Link:
    """A slender link along x of its frame, and its joint with axis y and initial angle ``bend``, in SI units."""

    length: float
    mass: float
    damping: float
    friction: float
    axis: int
    bend: float


_LINKS: Final = (
    _Link(0.30, 1.2, 0.08, 0.06, 1, np.pi / 2),  # hangs down
    _Link(0.25, 0.8, 0.05, 0.04, 1, -np.pi / 2),  # drawn straight out
    _Link(0.20, 0.4, 0.02, 0.015, -1, 0.0),
)
HANGING: Final = (0.0, np.pi / 2, 0.0)  # where the arm rests [rad]
LAST_MASS: Final = _LINKS[-1].mass  # kg
TORQUES: Final = (2.5, 1.2, 0.3)  # largest drive torques, a third to three quarters of the gravity torques [N m]


def urdf(payload: float = 0.0) -> str:
    """Return the arm's URDF with bent elbow and reversed wrist axis, and with a mass [kg] fixed to its tool."""
    parts, parent, at = ['<robot name="arm"><link name="base"/>'], "base", 0.0
    for name, link in zip(JOINTS, _LINKS, strict=True):
        across = link.mass * link.length**2 / 12
        inertia = f'<inertia ixx="1e-4" iyy="{across:.9g}" izz="{across:.9g}" ixy="0" ixz="0" iyz="0"/>'
        parts.append(
            f'<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{name}_link"/>'
            f'<origin xyz="{at:g} 0 0" rpy="0 {link.bend:.17g} 0"/><axis xyz="0 {link.axis} 0"/>'
            f'<dynamics damping="{link.damping:g}" friction="{link.friction:g}"/></joint>'
            f'<link name="{name}_link"><inertial><origin xyz="{link.length / 2:g} 0 0"/>'
            f'<mass value="{link.mass:g}"/>{inertia}</inertial></link>'
        )
        parent, at = f"{name}_link", link.length
    parts.append(_fixed("tool", parent, at) + '<link name="tool"/>')
    if payload > 0:
        ball = " ".join(f'{moment}="{0.4 * payload * RADIUS**2:.9g}"' for moment in ("ixx", "iyy", "izz"))
        parts.append(
            f'{_fixed("payload", "tool", 0.0)}<link name="payload"><inertial><mass value="{payload:.17g}"/>'
            f'<inertia {ball} ixy="0" ixz="0" iyz="0"/></inertial></link>'
        )
    return "".join(parts) + "</robot>"


def _fixed(name: str, parent: str, at: float) -> str:
    ends = f'<parent link="{parent}"/><child link="{name}"/>'
    return f'<joint name="{name}_mount" type="fixed">{ends}<origin xyz="{at:g} 0 0"/></joint>'


def torques(random: np.random.Generator, rows: int) -> Array:
    """Return three sines at each joint, which start within half a second, (rows, 3) [N m]."""
    t = np.arange(rows)[:, None, None] / RATE
    frequency, phase = random.uniform(0.3, 2.5, (3, 3)), random.uniform(0, 2 * np.pi, (3, 3))
    share = random.dirichlet(np.ones(3), 3)
    wave: Array = np.sum(share * np.sin(2 * np.pi * frequency * t + phase), axis=2)
    return np.asarray(TORQUES) * np.minimum(t[:, :, 0] / 0.5, 1.0) * wave


def motion(text: str, torque: Array, substeps: int = SUBSTEPS) -> Array:
    """Simulate a URDF's joints from rest, with torques held from row to row; return angles (rows, n) [rad]."""
    engine = mujoco.MjModel.from_xml_string(text)
    engine.opt.integrator, engine.opt.timestep = mujoco.mjtIntegrator.mjINT_RK4, 1 / (RATE * substeps)
    engine.dof_solref[:], engine.dof_solimp[:] = (2.01 * engine.opt.timestep, 1.0), _HARD
    data, angles = mujoco.MjData(engine), np.empty_like(torque)
    data.qpos[:] = HANGING
    for row, now in enumerate(torque):
        angles[row] = data.qpos
        data.qfrc_applied[:] = now
        mujoco.mj_step(engine, data, substeps)
    return angles
