"""Arms and postures drawn by hypothesis: 1 to 7 sections, 3 to 7 cables at uneven azimuths, any twist."""

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

from continuum.arm import Arm, Section
from continuum.kinematics.configuration import allen_from_jones

LAW = settings(deadline=None, max_examples=40, derandomize=True)
"""How often a law is tried; the same examples every time."""


@st.composite
def sections(draw: st.DrawFn, name: str = "section") -> Section:
    """A section of ordinary proportions."""
    n_joints = draw(st.integers(1, 9))
    b, a = draw(st.floats(0.008, 0.03)), draw(st.floats(0.02, 0.05))
    gaps = np.array(draw(st.lists(st.floats(1.0, 3.0), min_size=3, max_size=7)))
    azimuths = draw(st.floats(-3.0, 3.0)) + 2 * np.pi * np.cumsum(gaps) / np.sum(gaps)
    return Section(
        name=name,
        n_joints=n_joints,
        b=b,
        a=a,
        twist=draw(st.floats(-np.pi, np.pi)),
        cable_azimuths=tuple(float(azimuth) for azimuth in np.angle(np.exp(1j * azimuths))),
        bend_limit=float(min(0.9 * 2 * n_joints * np.arctan(b / a), 5.5)),
    )


@st.composite
def arms(draw: st.DrawFn) -> Arm:
    """An arm whose sections differ."""
    n_sections = draw(st.integers(1, 7))
    return Arm(tuple(draw(sections(name=f"section_{i + 1}")) for i in range(n_sections)))


@st.composite
def postures_of(draw: st.DrawFn, arm: Arm) -> np.ndarray:
    """A configuration (n_sections, 2) [rad] within the bend limits, straight sections among them."""
    n = arm.n_sections
    phi = np.array(draw(st.lists(st.floats(-np.pi, np.pi), min_size=n, max_size=n)))
    share = np.array(draw(st.lists(st.floats(0.0, 1.0), min_size=n, max_size=n)))
    return allen_from_jones(phi, share * [section.bend_limit for section in arm.sections])


@st.composite
def arms_and_postures(draw: st.DrawFn) -> tuple[Arm, np.ndarray]:
    """An arm and a configuration of it (n_sections, 2) [rad]."""
    arm = draw(arms())
    return arm, draw(postures_of(arm))
