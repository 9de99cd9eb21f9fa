"""`continuum report`: what a recorded kinematic run shows."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from continuum.arm import load_arm
from continuum.cli.tables import print_pairs
from continuum.errors import FileError, InvalidValueError
from continuum.output_files import check_apart

if TYPE_CHECKING:
    from continuum.recordings.kinematic_report import KinematicReport


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "report", help="tracking error, cable rates and losses of a recording", description=__doc__
    )
    parser.add_argument("recording", metavar="RECORDING", help="folder of a rosbag2 recording")
    parser.add_argument("--arm", metavar="ARM.yaml", required=True, help="parameter file of the arm that was recorded")
    parser.add_argument("--out", metavar="DIR", help="write cable_states.csv and cables.png there")
    parser.add_argument(
        "--expected", metavar="N", type=int, help="poses published, to tell what was lost before recording"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print the summary, and write the table and the picture if a folder is given."""
    # Here, so that the other commands need neither rosbags nor the time to load it and Matplotlib.
    from continuum.recordings.arm_recording import read_arm_recording
    from continuum.recordings.bag import Bag
    from continuum.recordings.cable_figure import write_cable_figure
    from continuum.recordings.cable_table import write_cable_table
    from continuum.recordings.kinematic_report import report_on

    if options.expected is not None and options.expected < 0:
        raise InvalidValueError("--expected", options.expected, "a whole number >= 0")
    folder = None if options.out is None else Path(options.out)
    outputs = [] if folder is None else [folder / "cable_states.csv", folder / "cables.png"]
    check_apart(outputs, (options.recording, options.arm))
    with Bag(options.recording) as bag:
        recording = read_arm_recording(bag, load_arm(options.arm))
    _show(report_on(recording, options.expected))
    if folder is not None:
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise FileError(folder, f"cannot be written ({error.strerror or error})") from error
        for write, file in zip((write_cable_table, write_cable_figure), outputs, strict=True):
            write(recording, file)
        print(f"written: {', '.join(map(str, outputs))}")
    return 0


def _show(report: KinematicReport) -> None:
    pairs = [
        ("poses", f"{report.n_targets} at {report.rate:.1f} Hz over {report.duration:.1f} s"),
        ("poses reached", str(report.n_solved)),
        ("tip error of the reached poses", _tip_error(report)),
        ("cable rate against slope of length", _rate_disagreement(report)),
        ("messages lost", str(report.n_lost)),
    ]
    pairs += [(f"lost on {name}", str(count)) for name, count in report.lost.items() if count]
    pairs += [(f"repeated on {name}", str(count)) for name, count in report.repeated.items() if count]
    print_pairs(pairs)


def _tip_error(report: KinematicReport) -> str:
    if math.isnan(report.tip_error_max):
        return "no pose was reached"
    return f"median {1e3 * report.tip_error_median:.2g} mm, max {1e3 * report.tip_error_max:.2g} mm"


def _rate_disagreement(report: KinematicReport) -> str:
    if math.isnan(report.rate_disagreement):
        return "no rates were recorded"
    return (
        f"{1e3 * report.rate_disagreement:.3f} mm/s at worst,\n{100 * report.rate_disagreement_ratio:.2f} % of the "
        f"largest, {1e3 * report.largest_rate:.1f} mm/s"
    )
