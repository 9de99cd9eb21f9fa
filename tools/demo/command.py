"""The command line of the demo, and its sequence from the trajectory to the report."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from ament_index_python.packages import get_package_share_directory

import tools.demo
from continuum.arm import load_arm
from continuum.cli import main as continuum
from continuum.errors import ContinuumError
from continuum.parameter_file import flattened, read_parameter_file
from tools.demo.domain import domain_for_demo
from tools.demo.folder import claimed
from tools.demo.hidden_process import finding_hidden_effect, search_log
from tools.demo.nodes import run_nodes
from tools.demo.viewer import viewed
from trajectory_generator.from_parameters import trajectory_from_mapping

SEED = 12
"""Seed of an effect that the diagnosis names with certainty; others may end in `ambiguous` or `unknown`."""


def main(arguments: list[str] | None = None) -> int:
    """Run the demo; return 0 if all of it was completed, 1 if not."""
    arm, trajectory = (
        Path(get_package_share_directory(package)) / "config" / name
        for package, name in (("continuum_description", "three_sections.yaml"), ("trajectory_generator", "helix.yaml"))
    )
    parser = argparse.ArgumentParser(prog="make demo ARGS=...", description=tools.demo.__doc__)
    parser.add_argument("--trajectory", type=Path, default=trajectory, metavar="FILE.yaml", help="default: %(default)s")
    parser.add_argument("--arm", type=Path, default=arm, metavar="ARM.yaml", help="default: %(default)s")
    parser.add_argument("--out", type=Path, default=Path("out/demo"), metavar="FOLDER", help="default: %(default)s")
    parser.add_argument(
        "--seed",
        type=int,
        default=SEED,
        metavar="N",
        help="seed of the hidden effect; default: %(default)s",
    )
    parser.add_argument("--helix-only", action="store_true", help="hide and find no effect")
    parser.add_argument("--view", action="store_true", help="show the arm in a browser, as with make demo VIEW=1")
    options = parser.parse_args(arguments)
    try:
        if (options.arm, options.trajectory) == (arm, trajectory):
            print("The helix of thesis 4.1, and an arm of three sections of Table 1's modules: all of it within reach.")
        seed = None if options.helix_only else options.seed
        return run_demo(options.trajectory, options.arm, options.out, seed, options.view)
    except ContinuumError as error:
        print(f"demo: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        recording = options.out / "recording"
        kept = f"; what was recorded until then is in {recording}" if recording.exists() else ""
        print(f"demo: interrupted{kept}", file=sys.stderr)
        raise


def _search(seed: int | None, out: Path) -> AbstractContextManager[subprocess.Popen[bytes] | None]:
    return nullcontext() if seed is None else finding_hidden_effect(seed, out)


def run_demo(trajectory_file: Path, arm_file: Path, out: Path, seed: int | None, view: bool = False) -> int:
    """Let the arm follow the trajectory, and find an effect hidden in a simulated arm; write the results to ``out``.

    Returns:
        Exit code: 0, or 1 if not every pose became a cable state.

    Raises:
        ContinuumError: a file is invalid, a node died, or the demo cannot start.
        KeyboardInterrupt: the user interrupted; all nodes have ended.
    """
    parameters = flattened(read_parameter_file(trajectory_file))
    times = trajectory_from_mapping(parameters).times(parameters["rate"])
    arm = load_arm(arm_file)
    print(
        f"{times[-1]:.1f} s at {parameters['rate']:g} Hz; {arm.n_sections} sections, {1e3 * arm.length:.1f} mm long; "
        f"results go to {out}/."
    )
    with domain_for_demo() as domain, claimed(out), _search(seed, out) as search:
        with viewed(arm_file, out, domain) if view else nullcontext():
            finished = run_nodes(trajectory_file, arm_file, out, domain, len(times))
        if not finished:
            print(f"demo: not every pose became a cable state; see {out}/nodes.log", file=sys.stderr)
        words = ["report", out / "recording", "--arm", arm_file, "--out", out, "--expected", len(times)]
        status = continuum([str(word) for word in words])
        found = search is None or search.wait() == 0
        if search is not None:
            print("\n" + search_log(out).read_text(encoding="utf-8"), end="")
    if view:
        print(f"to see it again: continuum view {out}/recording --arm {os.path.relpath(arm_file)}")
    return 0 if finished and status == 0 and found else 1
