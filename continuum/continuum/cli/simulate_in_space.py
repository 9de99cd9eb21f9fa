"""`continuum simulate` of an arm in space: all sections of an arm file."""

from __future__ import annotations

import argparse
import math
import sys
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

_PLANAR = ("pulled", "torques", "integrator")
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
    from continuum.dynamics.spatial.simulation import STEP, simulate_arm
    from continuum.dynamics.trajectory import SimulationStatus

    for name in _PLANAR:
        if given := getattr(options, name):
            raise InvalidValueError(f"--{name}", given, "left out, of an arm with several sections")
    model = load_arm_model(options.model)
    commands = _commands(options, model)
    at = times(options, np.zeros(1) if commands is None else commands.times)
    bends = release_bends(options.release or "0", model.arm.n_sections)
    _check_bends(options, model, bends)
    initial, step = model.bent(bends), STEP if options.step is None else options.step
    began = time.perf_counter()
    simulate_arm(model, initial, at[:1], commands)  # nothing to integrate, but the compiled loops are loaded
    loaded = time.perf_counter()
    try:
        motion = simulate_arm(model, initial, at, commands, step=step)
    except InvalidValueError as error:
        raise InvalidValueError("--step" if error.name == "step" else error.name, error.value, error.allowed) from None
    found = _figures(model, motion, loaded - began, time.perf_counter() - loaded)
    if options.json:
        print_json(found)
    else:
        print_pairs(_in_words(model, found, motion.status.value))
    if motion.status is not SimulationStatus.COMPLETE:
        return 1
    if found["greatest_bend"] > math.pi:
        print("continuum: no joint bends by more than half a turn; nothing is written", file=sys.stderr)
        return 1
    if found["greatest_bend"] > found["contact_bend"]:
        print(
            f"continuum: a joint bends by {math.degrees(found['greatest_bend']):.1f} degrees; the holes of its discs "
            f"meet at {math.degrees(found['contact_bend']):.1f}, which the model does not know",
            file=sys.stderr,
        )
    from continuum.recordings.spatial_motion_table import write_spatial_table

    write(options.csv, lambda path: write_spatial_table(model, motion, commands, path))
    if options.picture is not None:
        from continuum.recordings.spatial_motion_figure import write_spatial_figure

        write(options.picture, lambda path: write_spatial_figure(model, motion, commands, path))
    announce([options.csv, options.picture], "nothing written; --csv and --picture name files", apart=options.json)
    return 0


def _check_bends(options: argparse.Namespace, model: ArmModel, bends: Array) -> None:
    """Refuse bends beyond which discs meet.

    Raises:
        InvalidValueError: there is one.
    """
    for section, theta in zip(model.arm.sections, np.hypot(*bends.T), strict=True):
        if theta > section.contact_bend:
            allowed = (
                f"at most {math.degrees(section.contact_bend):.4g} degrees, where cable holes of {section.name} meet"
            )
            raise InvalidValueError("--release", options.release, allowed)


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
    from continuum.dynamics.spatial.simulation import CableCommands, path_lengths
    from continuum.recordings.input_table import read_cable_table
    from continuum.recordings.motion_columns import LENGTH, TENSION

    n = len(model.cable_names)
    if options.tensions is not None and options.lengths is not None:
        raise InvalidValueError("--lengths", options.lengths, "without --tensions")
    if options.tensions is not None:
        return CableCommands(*read_cable_table(options.tensions, n, TENSION))
    if options.lengths is None:
        return None
    times, lengths = read_cable_table(options.lengths, n, LENGTH)
    straight = path_lengths(model, np.zeros((1, model.n)))[0]
    for column, length in enumerate(straight):
        if not np.all((lengths[:, column] > 0.1 * length) & (lengths[:, column] < 2.0 * length)):
            allowed = f"lengths of {model.cable_names[column]} in m; of the straight arm it is {length:.6g}"
            raise InvalidValueError(f"--lengths, column l{column + 1}_m", float(lengths[0, column]), allowed)
    return CableCommands(times, lengths, holds=np.ones(n, bool))


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
        "greatest_bend": None,
        "contact_bend": min(section.contact_bend / section.n_joints for section in model.arm.sections),
        "tip_first": None,
        "tip_last": None,
        "lengths": None,
    }
    if np.isfinite(motion.q).all():
        found["bends"] = model.bends(motion.q[-1:])[0].tolist()
        found["greatest_bend"] = float(np.hypot(motion.q[:, ::2], motion.q[:, 1::2]).max())
        tips = tip_poses(model, motion.q[[0, -1]])[0]
        found["tip_first"], found["tip_last"] = tips[0].tolist(), tips[1].tolist()
        found["lengths"] = path_lengths(model, motion.q[-1:])[0].tolist()
    return found


def _in_words(model: ArmModel, found: dict[str, Any], status: str) -> list[tuple[str, str]]:
    """Return the figures for a table."""
    from continuum.kinematics.configuration import jones_from_allen

    differs = f"angles with twice the step differ by up to {math.degrees(found['error']):.2g} degrees"
    if not math.isfinite(found["error"]):
        differs = "with twice the step there is no solution"
    timing = f"{found['integration_time']:.3g} s for the integration, {found['loading_time']:.2f} s before it to load"
    pairs = [
        ("arm", f"{model.arm.n_sections} sections, {model.n} degrees of freedom, {found['cables']} cables"),
        ("integration", status),
        ("simulated", f"{found['duration']:g} s, {found['samples']} samples"),
        ("steps", f"{1e3 * found['step']:g} ms; {differs}"),
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
