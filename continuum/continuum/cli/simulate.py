"""`continuum simulate`: let a bent arm go, or pull its cables, and see how it moves."""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from continuum.arrays import Array
from continuum.cli import simulate_in_space
from continuum.cli.completion import completes_files
from continuum.cli.models import DEFAULT_MODEL, add_model_option, read_model
from continuum.cli.outputs import announce, check_outputs, print_json, write
from continuum.cli.tables import print_pairs
from continuum.errors import ContinuumError, InvalidValueError
from continuum.shipped_files import ARMS

if TYPE_CHECKING:
    from continuum.dynamics.input_signal import InputSignal
    from continuum.dynamics.model import Model
    from continuum.dynamics.pulled_posture import PulledPosture
    from continuum.dynamics.trajectory import Trajectory

_RELEASE_DURATION = 1.6
"""Duration [s] where nothing says one: that of the thesis's release tests."""

_MOST_SAMPLES = 10_000_000


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "simulate", help="simulate the motion of an arm that is released or pulled", description=__doc__,
        epilog="Exit codes: 0 done, 1 the integration failed or bends a joint by more than half a turn, 2 wrong usage, "
        "file or value.",
    )  # fmt: skip
    completes_files(parser.add_argument("file", metavar="ARM.yaml", nargs="?", help="the same as --model"), ARMS)
    add_model_option(parser)
    parser.add_argument(
        "--release", metavar="DEG",
        help="initial bend, at rest [degrees]: either the total, distributed equally over the joints, or one angle per "
        "joint (q1,q2,..); of several sections the bend of each, with its azimuth (40@0,30@90,..); default 0",
    )  # fmt: skip
    parser.add_argument(
        "--pulled", action="store_true",
        help="the total bend of --release is held by one cable, not distributed equally; the cable is cut at 0 s, when "
        "the output begins",
    )  # fmt: skip
    parser.add_argument(
        "--tensions", metavar="FILE.csv",
        help="cable tensions over time: columns t_s,u1_N,u2_N (of several sections all cables, from the base), linear "
        "between rows; if a table begins after 0 s, its first row holds from 0 s",
    )  # fmt: skip
    parser.add_argument(
        "--lengths", metavar="FILE.csv",
        help="lengths of the cables that their motors hold, of an arm with several sections: columns t_s,l1_m,..; "
        "otherwise as for --tensions",
    )  # fmt: skip
    parser.add_argument(
        "--torques", metavar="FILE.csv",
        help="torques of the joints' drives over time, for a model driven by joint torques: columns t_s,tau1_Nm,..; "
        "otherwise as for --tensions",
    )  # fmt: skip
    parser.add_argument(
        "--duration", metavar="S", type=float,
        help=f"duration [s]; default: until the end of the table, or {_RELEASE_DURATION:g} s without one",
    )  # fmt: skip
    parser.add_argument(
        "--rate", metavar="HZ", type=float, default=120.0, help="samples per second; default %(default)g"
    )
    parser.add_argument(
        "--step", metavar="S", type=float,
        help="of several sections: step from which the error is estimated [s]; the motion itself has half of it; "
        "default 0.001",
    )  # fmt: skip
    parser.add_argument(
        "--integrator", choices=("esdirk", "bdf"),
        help="of one section: esdirk, the default, is faster, bdf is that of the thesis",
    )  # fmt: skip
    parser.add_argument(
        "--csv",
        metavar="OUT.csv",
        help="write time, joint angles and rates, and tensions; in space angles, tip and cable lengths",
    )
    parser.add_argument("--picture", metavar="OUT.png", help="plot the same quantities and draw the arm")
    parser.add_argument(
        "--json", action="store_true", help="print one line of JSON instead of the table, in N, rad, rad/s and s"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Simulate, print a summary, and write what was asked for; 1 where the integration fails."""
    # Here, so that the other commands need neither CasADi and numba nor the time to load them and Matplotlib.
    from continuum.cli.simulation_figures import figures, in_words
    from continuum.cli.simulation_hints import beyond_contact, hints
    from continuum.dynamics.measuring import as_read
    from continuum.dynamics.trajectory import SimulationStatus
    from continuum.recordings.motion_table import write_motion_table

    if options.file is not None:
        if options.model != DEFAULT_MODEL:
            raise InvalidValueError("--model", options.model, f"left out, where {options.file} is named before")
        options.model = options.file
    if options.pulled and options.release is None:
        raise ContinuumError("--pulled needs --release, one total bend in degrees")
    if options.pulled and "," in options.release:
        raise InvalidValueError("--release", options.release, "with --pulled, one total bend in degrees")
    given = (options.model, options.tensions, options.torques, options.lengths)
    check_outputs(given, [options.csv], [options.picture])
    if simulate_in_space.is_meant(options):
        return simulate_in_space.run(options, _times)
    for name in ("lengths", "step"):
        if (value := getattr(options, name)) is not None:
            raise InvalidValueError(f"--{name}", value, "left out, of one section")
    model = read_model(options.model, options.section)
    for option in ("tensions", "pulled"):
        if getattr(options, option):
            model.require_cables(f"--{option}")
    posture = release_posture(options.release or "0", model.n_joints)
    inputs = _inputs(options, model)
    times = _times(options, inputs.times)
    for hint in hints(posture, inputs, model.parameters, times):
        print(f"continuum: {hint}", file=sys.stderr)
    held = _held(model, posture, options.release) if options.pulled else None
    began = time.perf_counter()
    simulate = _simulation(model, posture if held is None else held.theta, times, inputs, options.integrator)
    loaded = time.perf_counter()
    motion = simulate()
    found = figures(motion, held, loaded - began, time.perf_counter() - loaded)
    if options.json:
        print_json(found)
    else:
        print_pairs(in_words(found, motion.status.value))
    if motion.status is not SimulationStatus.COMPLETE:
        return 1
    bent = beyond_contact(motion.theta, model.parameters)
    if bent:
        print(f"continuum: {bent}, which the model does not know", file=sys.stderr)
    if model.parameters.has_cables and np.abs(motion.theta).max() > math.pi:
        print("continuum: no joint bends by more than half a turn; nothing is written", file=sys.stderr)
        return 1
    seen = as_read(model, motion)
    if not np.array_equal(seen.states, motion.states):
        print("continuum: angles and rates are those that the model's sensors read", file=sys.stderr)
    write(options.csv, lambda path: write_motion_table(seen, inputs, path))
    if options.picture is not None:
        from continuum.recordings.motion_figure import write_motion_figure

        write(options.picture, lambda path: write_motion_figure(seen, inputs, model.parameters, path))
    announce([options.csv, options.picture], "nothing written; --csv and --picture name files", apart=options.json)
    return 0


def release_posture(text: str, n_joints: int) -> Array:
    """Joint angles (n_joints,) [rad] of a total bend in degrees, or of one angle for each joint, as ``10,12.5,..``.

    Raises:
        InvalidValueError: another number of angles, no numbers, or more than half a turn in a joint.
    """
    try:
        degrees = np.array([float(part) for part in text.split(",")])
    except ValueError:
        degrees = np.array([math.nan])
    if degrees.size == 1:
        degrees = np.repeat(degrees / n_joints, n_joints)
    if degrees.size != n_joints or not np.all(np.abs(degrees) <= 180):
        allowed = f"a total bend, or {n_joints} joint angles with commas between them, up to 180 degrees a joint"
        raise InvalidValueError("--release", text, allowed)
    return np.radians(degrees)


def _inputs(options: argparse.Namespace, model: Model) -> InputSignal:
    """What drives the arm over time."""
    from continuum.dynamics.model import InputKind
    from continuum.dynamics.model_inputs import undriven
    from continuum.recordings.input_table import read_tension_table, read_torque_table

    if options.tensions is not None and options.torques is not None:
        raise InvalidValueError("--torques", options.torques, "without --tensions")
    if options.tensions is not None:
        return read_tension_table(options.tensions)
    if options.torques is None:
        return undriven(model)
    if model.inputs is not InputKind.JOINT_TORQUES:
        raise InvalidValueError(
            "--torques", options.torques, f"with a model that joint torques drive, not {options.model}"
        )
    return read_torque_table(options.torques, model.n_joints)


def _held(model: Model, posture: Array, release: str) -> PulledPosture:
    """The posture with the same total bend (n_joints,) [rad] that one cable holds."""
    from continuum.dynamics.pulled_posture import pulled_posture

    try:
        return pulled_posture(model, float(posture.sum()))
    except InvalidValueError as error:  # of an angle in radians, which nobody typed
        raise InvalidValueError("--release", release, f"with --pulled, {error.allowed}") from None


def _times(options: argparse.Namespace, of_inputs: Array) -> Array:
    """Output times from the inputs' first instant on, 0 where that is later [s]."""
    for name in ("duration", "rate"):
        value = getattr(options, name)
        if value is not None and not 0 < value < math.inf:
            raise InvalidValueError(f"--{name}", value, f"a number > 0 [{'s' if name == 'duration' else 'Hz'}]")
    begin = min(0.0, float(of_inputs[0]))
    lasts = float(of_inputs[-1]) - begin
    duration = options.duration or (lasts if lasts > 0 else _RELEASE_DURATION)
    samples = duration * options.rate
    if not 1 <= samples + 1e-6 <= _MOST_SAMPLES:
        what = "--duration" if options.duration else f"the {duration:g} s to be simulated"
        raise InvalidValueError(f"{what} times --rate", samples, f"1 to {_MOST_SAMPLES} samples")
    return begin + np.arange(int(samples + 1e-6) + 1) / float(options.rate)


def _simulation(
    model: Model, posture: Array, times: Array, inputs: InputSignal, integrator: str | None
) -> Callable[[], Trajectory]:
    """What is to be called for the integration alone: equations are compiled here, and all code is loaded."""
    if integrator == "bdf":
        from continuum.dynamics.compiled.equations import CompiledEquations
        from continuum.dynamics.integration.scipy_bdf import simulate_bdf

        equations = CompiledEquations(model)
        return lambda: simulate_bdf(model, posture, times, inputs, equations=equations)
    from continuum.dynamics.simulator import Simulator

    simulator = Simulator(model)
    simulator.run(posture, times[:1])  # nothing to integrate, but the compiled loops are loaded
    return lambda: simulator.run(posture, times, inputs)
