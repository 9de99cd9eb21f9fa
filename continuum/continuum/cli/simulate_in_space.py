"""`continuum simulate` of an arm in space: all sections of an arm file."""

from __future__ import annotations

import argparse
import math
import time
from typing import TYPE_CHECKING, Any

import numpy as np

from continuum.arrays import Array
from continuum.cli.outputs import announce, print_json, write
from continuum.cli.tables import print_pairs
from continuum.errors import InvalidValueError

if TYPE_CHECKING:
    from continuum.dynamics.spatial.arm_model import ArmModel
    from continuum.dynamics.spatial.simulation import CableCommands, SpatialMotion

_DURATION = 1.6
"""Duration [s] without a table: that of the thesis's release tests."""

_PLANAR = {"pulled": "--pulled", "torques": "--torques"}
"""Options of one section in a plane."""


def is_meant(options: argparse.Namespace) -> bool:
    """Whether the options name an arm file with several sections, and none of them.

    Raises:
        FileError: the file cannot be read.
    """
    from continuum.dynamics.model_file import sections_in

    return options.section is None and len(sections_in(options.model)) > 1


def run(options: argparse.Namespace, times: Any) -> int:
    """Simulate, print a summary, and write what was asked for; 1 where the integration fails.

    Args:
        options: of the command line.
        times: function from the table's times to the output times.
    """
    from continuum.dynamics.spatial.arm_model import load_arm_model
    from continuum.dynamics.spatial.simulation import simulate_arm
    from continuum.dynamics.trajectory import SimulationStatus

    for name, option in _PLANAR.items():
        if getattr(options, name):
            raise InvalidValueError(option, getattr(options, name), "left out, of an arm with several sections")
    if options.integrator != "esdirk":
        raise InvalidValueError("--integrator", options.integrator, "left out, of an arm with several sections")
    model = load_arm_model(options.model)
    commands = _commands(options, model)
    at = times(options, np.zeros(1) if commands is None else commands.times)
    initial = model.bent(release_bends(options.release or "0", model.arm.n_sections))
    began = time.perf_counter()
    simulate_arm(model, initial, at[:1], commands)  # nothing to integrate, but the compiled loops are loaded
    loaded = time.perf_counter()
    motion = simulate_arm(model, initial, at, commands, step=options.step)
    found = _figures(model, motion, loaded - began, time.perf_counter() - loaded)
    if options.json:
        print_json(found)
    else:
        print_pairs(_in_words(model, found, motion.status.value))
    if motion.status is not SimulationStatus.COMPLETE:
        return 1
    from continuum.recordings.spatial_motion_table import write_spatial_table

    write(options.csv, lambda path: write_spatial_table(model, motion, commands, path))
    if options.picture is not None:
        from continuum.recordings.spatial_motion_figure import write_spatial_figure

        write(options.picture, lambda path: write_spatial_figure(model, motion, commands, path))
    announce([options.csv, options.picture], "nothing written; --csv and --picture name files", apart=options.json)
    return 0


def release_bends(text: str, n_sections: int) -> Array:
    """Bends (n_sections, 2), Allen's (u, v) [rad], of a text like ``40@0,30@90``: degrees and azimuth of each section.

    One bend holds for all sections; an azimuth that is left out is 0, towards x of the section's frame.

    Raises:
        InvalidValueError: another number of bends, or what is no number.
    """
    from continuum.kinematics.configuration import allen_from_jones

    allowed = f"one bend, or {n_sections} with commas between them, as 40 or 40@90: degrees, and the azimuth in degrees"
    bends = []
    for part in text.split(","):
        bend, _, azimuth = part.partition("@")
        try:
            bends.append([float(azimuth or 0.0), float(bend)])
        except ValueError:
            raise InvalidValueError("--release", text, allowed) from None
    if len(bends) == 1:
        bends *= n_sections
    given = np.radians(bends)
    if len(bends) != n_sections or not np.all(np.isfinite(given)):
        raise InvalidValueError("--release", text, allowed)
    return allen_from_jones(given[:, 0], given[:, 1])


def _commands(options: argparse.Namespace, model: ArmModel) -> CableCommands | None:
    """Tensions or lengths of all cables."""
    from continuum.dynamics.spatial.simulation import CableCommands
    from continuum.recordings.input_table import read_cable_table
    from continuum.recordings.motion_columns import LENGTH, TENSION

    n = len(model.cable_names)
    if options.tensions is not None and options.lengths is not None:
        raise InvalidValueError("--lengths", options.lengths, "without --tensions")
    if options.tensions is not None:
        return CableCommands(*read_cable_table(options.tensions, n, TENSION))
    if options.lengths is not None:
        return CableCommands(*read_cable_table(options.lengths, n, LENGTH), holds=np.ones(n, bool))
    return None


def _figures(model: ArmModel, motion: SpatialMotion, loading_time: float, integration_time: float) -> dict[str, Any]:
    """All figures in SI units; those of an incomplete motion are None."""
    from continuum.dynamics.spatial.simulation import path_lengths, tip_poses

    found: dict[str, Any] = {
        "status": motion.status.name,
        "duration": float(motion.times[-1] - motion.times[0]),
        "samples": int(motion.times.size),
        "degrees_of_freedom": model.n,
        "cables": len(model.cable_names),
        "step": motion.step,
        "error": motion.error,
        "integration_time": integration_time,
        "loading_time": loading_time,
        "bends": None,
        "tip_first": None,
        "tip_last": None,
        "lengths": None,
    }
    if np.isfinite(motion.q).all():
        sections = range(model.arm.n_sections)
        last = motion.q[-1].reshape(-1, 2)
        found["bends"] = [last[model.section[::2] == k].sum(axis=0).tolist() for k in sections]
        tips = tip_poses(model, motion.q[[0, -1]])[0]
        found["tip_first"], found["tip_last"] = tips[0].tolist(), tips[1].tolist()
        found["lengths"] = path_lengths(model, motion.q[-1:])[0].tolist()
    return found


def _in_words(model: ArmModel, found: dict[str, Any], status: str) -> list[tuple[str, str]]:
    """Return the figures for a table."""
    from continuum.kinematics.configuration import jones_from_allen

    error = f"{math.degrees(found['error']):.2g}"
    timing = f"{found['integration_time']:.3g} s for the integration, {found['loading_time']:.2f} s before it to load"
    pairs = [
        ("arm", f"{model.arm.n_sections} sections, {model.n} degrees of freedom, {found['cables']} cables"),
        ("integration", status),
        ("simulated", f"{found['duration']:g} s, {found['samples']} samples"),
        ("steps", f"{1e3 * found['step']:g} ms; angles with twice the step differ by up to {error} degrees"),
        ("time taken", timing),
    ]
    if found["bends"] is None:
        return pairs
    for section, w in zip(model.arm.sections, found["bends"], strict=True):
        phi, theta = jones_from_allen(np.array(w))
        pairs.append((section.name, f"bent by {math.degrees(theta):.2f} degrees at azimuth {math.degrees(phi):.1f}"))
    for name in ("tip_first", "tip_last"):
        x, y, z = (1e3 * one for one in found[name])
        pairs.append((name.replace("_", " at "), f"({x:.1f}, {y:.1f}, {z:.1f}) mm"))
    return pairs
