"""Helpers of this package's tests: arms to describe, and a description read back by yourdfpy, an independent reader."""

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import yourdfpy
from hypothesis import strategies as st
from numpy.typing import NDArray

from continuum.arm import Arm, Section, load_arm
from continuum.urdf.robot import robot_urdf, to_text

SHIPPED_ARMS = tuple(sorted((Path(__file__).resolve().parents[1] / "config").glob("*.yaml")))


def shipped_arms() -> list[Arm]:
    """Every arm of config/."""
    return [load_arm(path) for path in SHIPPED_ARMS]


def shipped_name(path: Path) -> str:
    """Name of a shipped arm in a test's report."""
    return path.stem


@st.composite
def sections(draw: st.DrawFn, name: str) -> Section:
    """A section of up to five joints, with any proportions and three to five cables.

    The twist is a multiple of a microradian: the reader of these tests takes rotations under 1e-8 rad for none.
    """
    n_joints = draw(st.integers(1, 5))
    b, a = draw(st.floats(1e-3, 0.1)), draw(st.floats(1e-3, 0.1))
    n_cables = draw(st.integers(3, 5))
    return Section(
        name=name,
        n_joints=n_joints,
        b=b,
        a=a,
        twist=1e-6 * draw(st.integers(-6_000_000, 6_000_000)),
        cable_azimuths=tuple(2 * np.pi * j / n_cables for j in range(n_cables)),
        bend_limit=draw(st.floats(0.1, 0.99)) * 2 * n_joints * np.arctan2(b, a),
        link_mass=draw(st.floats(1e-3, 10.0)),
        link_inertia=draw(st.floats(1e-9, 1.0)),
    )


@st.composite
def arms(draw: st.DrawFn) -> Arm:
    """One to three sections."""
    return Arm(tuple(draw(sections(f"s_{i}")) for i in range(draw(st.integers(1, 3)))))


class Description:
    """The URDF of an arm, moved by the free joints of its sections.

    Args:
        arm: the arm.
        single_bends: every bending joint is free, as for who publishes an angle of each; else they mimic the first.
    """

    def __init__(self, arm: Arm, single_bends: bool = False) -> None:
        self.arm = arm
        robot = robot_urdf(arm)
        if single_bends:
            bending = {name for section in arm.sections for name in section.theta_joints}
            for joint in robot.iter("joint"):
                if joint.get("name") in bending and (mimic := joint.find("mimic")) is not None:
                    joint.remove(mimic)
        self.urdf = yourdfpy.URDF.load(io.BytesIO(to_text(robot).encode()), load_meshes=False)
        self.joints = {joint.name: joint for joint in self.urdf.robot.joints}
        self.links = {link.name: link for link in self.urdf.robot.links}

    def move(self, phi: NDArray, theta: NDArray) -> None:
        """Bend section i by ``theta[i]`` towards ``phi[i]`` [rad]."""
        free = {}
        for i, section in enumerate(self.arm.sections):
            free[section.phi_joint] = phi[i]
            free[section.theta_joints[0]] = theta[i] / section.n_joints
        self.urdf.update_cfg(free)

    def move_joints(self, phi: NDArray, thetas: Sequence[NDArray]) -> None:
        """Turn the plane of section i by ``phi[i]``, and bend its joints by ``thetas[i]`` (n_joints,) [rad]."""
        free = {}
        for section, turn, angles in zip(self.arm.sections, phi, thetas, strict=True):
            free[section.phi_joint] = turn
            free |= dict(zip(section.theta_joints, angles, strict=True))
        self.urdf.update_cfg(free)

    def pose(self, frame: str) -> NDArray:
        """Pose (4, 4) of a frame in base_link; lengths in m."""
        return self.urdf.get_transform(frame, "base_link")

    def disc_frames(self, section: Section) -> list[str]:
        """Frames of the section's discs from the base; the last is the tip."""
        return [f"{section.name}_disc_{k}" for k in range(1, section.n_joints)] + [section.tip_frame]


def random_posture(arm: Arm, generator: np.random.Generator) -> tuple[NDArray, NDArray]:
    """Azimuths phi and bends theta (n_sections,) [rad] within the joint limits, both ways."""
    limits = np.array([section.bend_limit for section in arm.sections])
    phi = generator.uniform(-np.pi, np.pi, arm.n_sections)
    return phi, generator.uniform(-1, 1, arm.n_sections) * limits
