"""Arms in space for tests: made at random, or of equal sections; and the same arms as MuJoCo's models."""

from __future__ import annotations

import mujoco
import numpy as np

from continuum.dynamics.spatial.cable_paths import Cables
from continuum.dynamics.spatial.chain import Chain
from continuum.dynamics.spatial.time_stepping import Joints

GRAVITY = np.array([0.0, 0.0, -9.81])


def rotation(vector: np.ndarray) -> np.ndarray:
    """Rotation matrix (3, 3) of a rotation vector (3,) [rad]."""
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * K + (1.0 - np.cos(angle)) * K @ K


def random_chain(rng: np.random.Generator, n_links: int, per_joint: int) -> Chain:
    """A chain with ``per_joint`` degrees of freedom in each joint, at random axes, offsets, masses and inertias."""
    n = n_links * per_joint
    axis = rng.normal(size=(n, 3))
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    offset, mass, center, inertia = np.zeros((n, 3)), np.zeros(n), np.zeros((n, 3)), np.zeros((n, 6))
    offset[::per_joint] = rng.normal(0.0, 0.05, (n_links, 3))
    bodies = np.arange(per_joint - 1, n, per_joint)
    mass[bodies] = rng.uniform(0.05, 0.5, n_links)
    center[bodies] = rng.normal(0.0, 0.02, (n_links, 3))
    for body in bodies:
        axes = rotation(rng.normal(size=3))
        moments = rng.uniform(1.0, 1.4, 3) * 1e-4  # of three, each at most the sum of the others
        full = axes @ np.diag(moments) @ axes.T
        inertia[body] = full[np.triu_indices(3)]
    return Chain(axis, offset, rotation(rng.normal(size=3)), mass, center, inertia, np.zeros(n), GRAVITY.copy())


def equal_sections(
    n_sections: int, n_joints: int, per_joint: int = 2, n_cables: int = 3, friction: float = 0.0
) -> tuple[Chain, Joints, Cables]:
    """An arm of equal sections of the prototype's links (Tables 1, 3) that hangs along -z.

    ``per_joint`` is 1 for planar joints (about y), 2 for universal ones (x, y), 3 with torsion.
    """
    spacing, radius = 0.0385, 0.032
    axes = np.eye(3)[[1]] if per_joint == 1 else np.eye(3)[:per_joint]
    n_links = n_sections * n_joints
    n = n_links * per_joint
    bodies = np.arange(per_joint - 1, n, per_joint)
    offset, mass, center, inertia = np.zeros((n, 3)), np.zeros(n), np.zeros((n, 3)), np.zeros((n, 6))
    offset[per_joint::per_joint, 2] = -spacing
    mass[bodies] = 0.222
    center[bodies, 2] = -spacing / 2
    inertia[np.ix_(bodies, [0, 3, 5])] = [79e-6, 79e-6, 100e-6]
    chain = Chain(np.tile(axes, (n_links, 1)), offset, np.eye(3), mass, center, inertia, np.zeros(n), GRAVITY.copy())
    every = np.ones(n)
    joints = Joints(1.2379 * every, 0.0 * every, 0.0314 * every, 0.0413 * every, 0.0 * every, 0.3 * every)
    holes, of, first = [], [], [0]
    for section in range(n_sections):
        for cable in range(n_cables):
            azimuth = 2.0 * np.pi * cable / n_cables + 0.5 * section
            x, y = radius * np.cos(azimuth), radius * np.sin(azimuth)
            holes += [[x, y, spacing / 2], *[[x, y, -spacing / 2]] * (section + 1) * n_joints]
            of += [-1, *bodies[: (section + 1) * n_joints]]
            first.append(len(of))
    each = np.ones(len(first) - 1)
    cables = Cables(
        np.array(first), np.array(of), np.array(holes), friction * each, 2e4 * each, 2e4 * each, 20.0 * each
    )
    return chain, joints, cables


def random_cables(rng: np.random.Generator, chain: Chain, n_cables: int) -> Cables:
    """Cables through holes at random places of the bodies with a mass."""
    bodies = [-1, *np.nonzero(chain.mass)[0]]
    of, first = [], [0]
    for _ in range(n_cables):
        of += bodies[: rng.integers(2, len(bodies) + 1)]
        first.append(len(of))
    each = np.ones(n_cables)
    holes = rng.normal(0.0, 0.05, (len(of), 3))
    return Cables(np.array(first), np.array(of), holes, 0.2 * each, 1e3 * each, 2e4 * each, 20.0 * each)


def in_mujoco(chain: Chain, joints: Joints | None, cables: Cables | None, step: float = 1e-3) -> mujoco.MjModel:
    """The same arm in MuJoCo: spatial tendons without friction, motors that pull them, and ``frictionloss``."""
    n = chain.axis.shape[0]
    text, open_bodies = [], 0
    holes: dict[int, list[str]] = {}
    if cables is not None:
        for k, (body, at) in enumerate(zip(cables.body, cables.hole, strict=True)):
            holes.setdefault(int(body), []).append(f'<site name="h{k}" pos="{_words(at)}"/>')
    quaternion = np.empty(4)
    mujoco.mju_mat2Quat(quaternion, chain.base.reshape(-1))
    text.append(f'<body quat="{_words(quaternion)}">' + "".join(holes.get(-1, [])))
    new = True
    for i in range(n):
        if new:
            text.append(f'<body pos="{_words(chain.offset[i])}">')
            open_bodies += 1
        law = "" if joints is None else (
            f' stiffness="{_words([joints.stiffness[i]])}" springref="{_words([np.rad2deg(joints.rest[i])])}"'
            f' damping="{_words([joints.viscous[i]])}" frictionloss="{_words([joints.coulomb[i]])}"'
        )  # fmt: skip
        text.append(f'<joint type="hinge" axis="{_words(chain.axis[i])}" armature="{_words([chain.rotor[i]])}"{law}/>')
        new = chain.mass[i] > 0.0
        if new:
            xx, xy, xz, yy, yz, zz = chain.inertia[i]
            text.append(
                f'<inertial pos="{_words(chain.center[i])}" mass="{_words([chain.mass[i]])}" '
                f'fullinertia="{_words((xx, yy, zz, xy, xz, yz))}"/>' + "".join(holes.get(i, []))
            )
    tendons, motors = "", ""
    for c in range(0 if cables is None else cables.first.size - 1):
        sites = "".join(f'<site site="h{k}"/>' for k in range(cables.first[c], cables.first[c + 1]))
        tendons += f'<spatial name="t{c}">{sites}</spatial>'
        motors += f'<motor tendon="t{c}" gear="-1"/>'
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="degree" balanceinertia="false"/><option timestep="{step!r}" '
        f'integrator="implicitfast" gravity="{_words(chain.gravity)}"><flag contact="disable"/></option>'
        f"<worldbody>{''.join(text)}"
        f"{'</body>' * (open_bodies + 1)}</worldbody><tendon>{tendons}</tendon><actuator>{motors}</actuator></mujoco>"
    )


def _words(numbers) -> str:
    return " ".join(repr(float(x)) for x in numbers)
