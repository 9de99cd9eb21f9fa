"""The arm that is assumed without an arm file: modules of Table 1 of the thesis."""

from __future__ import annotations

import math
from collections.abc import Iterable

from continuum.arm import Arm, Section
from continuum.errors import InvalidValueError
from continuum.joint_names import theta_joints

_B, _A = 0.01925, 0.032
_MODULES = 5
_WITHIN = 0.99  # bend limit relative to the bend at which discs touch

HOLES_TO_SPACING = _A / _B
"""Radius of the cables' holes relative to half the joint spacing."""


def default_arm(n_sections: int = 3) -> Arm:
    """Return an arm of sections of five modules, each rotated by a twelfth of a turn from the preceding section."""
    twists = [0.0] + [math.pi / 6] * (n_sections - 1)
    return Arm(tuple(Section(f"section_{i}", _MODULES, _B, _A, twist=twist) for i, twist in enumerate(twists, start=1)))


def reachable_bend(n_joints: int, b: float, a: float) -> float:
    """Return a bend limit of a section [rad]: half a turn, or less if the discs touch before."""
    return min(math.pi, _WITHIN * 2 * n_joints * math.atan2(b, a))


def arm_of_joints(joints: Iterable[str]) -> Arm:
    """Return an arm of untwisted sections of such modules that has the named joints; few modules lower the bend limit.

    Raises:
        InvalidValueError: no joint is the first of a section.
    """
    names, ending = list(joints), theta_joints("", 1)[0]
    sections = [name.removesuffix(ending) for name in names if name.endswith(ending)]
    if not sections:
        raise InvalidValueError("joints", names, f"bending joints, with names that end with {ending} ..")
    counts = [sum(name in names for name in theta_joints(section, len(names))) for section in sections]
    return Arm(
        tuple(
            Section(section, n, _B, _A, bend_limit=reachable_bend(n, _B, _A))
            for section, n in zip(sections, counts, strict=True)
        )
    )
