"""The arm that a model describes, for drawing it and for its description."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from continuum import joint_names
from continuum.arm import Arm, Section, load_arm
from continuum.dynamics.model_file import load_named_model
from continuum.dynamics.parameters import Parameters
from continuum.shipped_files import MODELS, find_file
from continuum.viewer.default_arm import HOLES_TO_SPACING, reachable_bend

_AZIMUTHS = (0.0, np.pi, np.pi / 2, 3 * np.pi / 2)
"""Azimuths of cables [rad]: 1 and 2 bend the model, as in `planar_prototype.yaml`; the others stay slack."""


def arm_of_model(path: str | Path, section: str | None, name: str | None = None) -> Arm:
    """Return an arm of one section: the one in an arm file, or a planar one with the dimensions of a model file.

    Args:
        path: a model file, or an arm file with a block `dynamics`; or the name of one of the library's.
        section: section of an arm file; None if there is only one.
        name: name of the returned section, as in a recording; None for that in the arm file, or else ``section_1``.

    Raises:
        FileError: the file cannot be read or describes no model.
        InvalidValueError: a value in it is not allowed.
    """
    model, modelled = load_named_model(path, section)
    if modelled is not None:
        (found,) = (one for one in load_arm(find_file(path, MODELS)).sections if one.name == modelled)
        return Arm((replace(found, name=name or found.name),))
    return Arm((planar_section(name or joint_names.DEFAULT_SECTION, model.parameters),))


def is_approximate(p: Parameters) -> bool:
    """Return whether `planar_section` has means of dimensions that vary along the arm, or no gaps between discs."""
    varying = [one for one in (p.joint_spacing, p.hole_radius) if one is not None]
    return bool(any(not np.allclose(one, one[0]) for one in varying) or not np.allclose(p.disc_gap, 0.0))


def planar_section(name: str, p: Parameters) -> Section:
    """Return a section with the joint spacing and hole radius of a planar model; their means if they vary.

    An arm without discs has holes in proportion to those of the prototype.
    """
    b = float(np.mean(p.joint_spacing)) / 2
    a = HOLES_TO_SPACING * b if p.hole_radius is None else float(np.mean(p.hole_radius))
    return Section(name, p.n_joints, b, a, cable_azimuths=_AZIMUTHS, bend_limit=reachable_bend(p.n_joints, b, a))
