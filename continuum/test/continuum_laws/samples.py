"""Sections, arms and postures that the laws are tried on: every switch of a series, every singularity, both sides."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from continuum.arm import Arm, Section
from continuum.kinematics.configuration import allen_from_jones

PROTOTYPE = Section(name="prototype", n_joints=5, b=0.01925, a=0.032)
"""Table 1 of the thesis."""

SECTIONS = (
    PROTOTYPE,
    Section(name="one_joint", n_joints=1, b=0.05, a=0.02, bend_limit=2.0),
    Section(name="two_joints", n_joints=2, b=0.015, a=0.04, bend_limit=1.4),
    Section(name="three_cables", n_joints=7, b=0.01, a=0.025, cable_azimuths=(0.2, 2.0, -2.5), bend_limit=4.5),
    Section(name="seven_cables", n_joints=30, b=0.004, a=0.03, cable_azimuths=(0, 0.5, 1.7, 2.2, 3.3, 4, 6), twist=1.0),
)

_TINY = (0.0, 1e-300, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 0.02)
_ORDINARY = (0.3, 1.0, 1.5, 2.5, 3.0, np.pi, 3.5, 4.4, 3 * np.pi / 2, 5.0, 6.0, 6.28)


def bends(section: Section) -> np.ndarray:
    """Bends [rad] from straight to a full turn, with both sides of the bends at which a series is switched."""
    n = section.n_joints
    switches = [s * (1 + side) for s in (0.1, 0.5, 1.0, 0.5 * n, n) for side in (-1e-9, 1e-9)]
    return np.array([*_TINY, *_ORDINARY, *(s for s in switches if s < 2 * np.pi)])


AZIMUTHS = np.array([0.0, 0.4, np.pi / 2, 2.5, np.pi, -2.0, -np.pi / 2, -0.01])


def postures(section: Section, largest: float = np.inf) -> np.ndarray:
    """Configurations (n, 2) [rad]: every bend up to ``largest`` at every azimuth."""
    theta = bends(section)
    theta = theta[theta <= largest]
    phi, theta = np.meshgrid(AZIMUTHS, theta)
    return allen_from_jones(phi.ravel(), theta.ravel())


def arm_of(n_sections: int, bend_limit: float = np.pi, twist: float = 0.0) -> Arm:
    """Prototype sections one after the other [rad]."""
    return Arm(
        tuple(
            replace(PROTOTYPE, name=f"section_{i + 1}", bend_limit=bend_limit, twist=twist) for i in range(n_sections)
        )
    )


def mixed_arm(n_sections: int) -> Arm:
    """The sections above in turn, each twisted and of its own size."""
    chosen = [SECTIONS[i % len(SECTIONS)] for i in range(n_sections)]
    return Arm(tuple(replace(s, name=f"section_{i}", twist=0.7 * i - 1.0) for i, s in enumerate(chosen)))


def limited(arm: Arm, bend_limits: Sequence[float]) -> Arm:
    """``arm`` with other bend limits [rad], one a section."""
    return Arm(tuple(replace(s, bend_limit=limit) for s, limit in zip(arm.sections, bend_limits, strict=True)))


def limits_of(arm: Arm) -> np.ndarray:
    """Bend limits (n_sections,) [rad]."""
    return np.array([section.bend_limit for section in arm.sections])


def random_postures(arm: Arm, n: int, seed: int, largest: float | None = None) -> np.ndarray:
    """Configurations (n, n_sections, 2) [rad], bends uniform up to the sections' limits or to ``largest``."""
    random = np.random.default_rng(seed)
    limit = limits_of(arm) if largest is None else np.full(arm.n_sections, largest)
    phi = random.uniform(-np.pi, np.pi, (n, arm.n_sections))
    return allen_from_jones(phi, random.uniform(0.0, limit, (n, arm.n_sections)))
