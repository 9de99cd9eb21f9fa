"""`continuum report`: what a recorded kinematic run shows."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from continuum.arm import load_arm
from continuum.recordings.arm_recording import read_arm_recording
from continuum.recordings.bag import Bag
from continuum.recordings.cable_figure import write_cable_figure
from continuum.recordings.cable_table import write_cable_table
from continuum.recordings.kinematic_report import KinematicReport, report_on


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
    with Bag(options.recording) as bag:
        recording = read_arm_recording(bag, load_arm(options.arm))
    _show(report_on(recording, options.expected))
    if options.out is not None:
        folder = Path(options.out)
        folder.mkdir(parents=True, exist_ok=True)
        write_cable_table(recording, folder / "cable_states.csv")
        write_cable_figure(recording, folder / "cables.png")
        print(f"written: {folder / 'cable_states.csv'}, {folder / 'cables.png'}")
    return 0


def _show(report: KinematicReport) -> None:
    worst, share, largest = report.rate_disagreement, report.rate_disagreement_ratio, report.largest_rate
    speed = f"{report.n_targets} at {report.rate:.1f} Hz over {report.duration:.1f} s, {report.n_solved} reached"
    error = f"median {1e3 * report.tip_error_median:.2g} mm, max {1e3 * report.tip_error_max:.2g} mm"
    slope = f"{1e3 * worst:.2g} mm/s apart at worst, {100 * share:.2f} % of the largest rate ({1e3 * largest:.1f} mm/s)"
    rows = [
        ("poses", speed),
        ("tip error, reached poses", error),
        ("cable rate, Jacobian against central difference", slope),
        ("messages lost", str(report.n_lost)),
    ]
    rows += [(f"  lost on {name}", str(count)) for name, count in report.lost.items() if count]
    table = Table(show_header=False)
    for row in rows:
        table.add_row(*row)
    Console().print(table)
