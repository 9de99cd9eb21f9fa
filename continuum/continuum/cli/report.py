"""`continuum report`: evaluate a recorded kinematic run."""

from __future__ import annotations

import argparse
import math
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from continuum.arm import load_arm
from continuum.cli.completion import completes_files
from continuum.cli.language_option import add_language_option
from continuum.cli.outputs import announce, check_outputs, print_json, write
from continuum.cli.tables import print_pairs
from continuum.errors import InvalidValueError
from continuum.languages import Translator, translator
from continuum.shipped_files import ARMS
from continuum.significant_digits import rounded

if TYPE_CHECKING:
    from continuum.recordings.kinematic_report import KinematicReport


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "report", help="report tracking error, cable rates and losses of a recording", description=__doc__
    )
    parser.add_argument("recording", metavar="RECORDING", help="folder of a rosbag2 recording")
    arm = parser.add_argument(
        "--arm", metavar="ARM.yaml", required=True,
        help="parameter file of the recorded arm, or the name of an arm in the library",
    )  # fmt: skip
    completes_files(arm, ARMS)
    parser.add_argument("--out", metavar="DIR", help="write cable_states.csv and cables.png to this folder")
    parser.add_argument(
        "--expected", metavar="N", type=int, help="number of published poses, to find those lost before recording"
    )
    parser.add_argument(
        "--json", action="store_true", help="print one line of JSON instead of the table, in s, Hz, m and m/s"
    )
    add_language_option(parser, "table")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Print the summary, and write the table and the picture if a folder is given."""
    # Imported here so that the other commands need not load rosbags and Matplotlib.
    from continuum.recordings.arm_recording import read_arm_recording
    from continuum.recordings.bag import Bag
    from continuum.recordings.cable_figure import write_cable_figure
    from continuum.recordings.cable_table import write_cable_table
    from continuum.recordings.kinematic_report import report_on

    if options.expected is not None and options.expected < 0:
        raise InvalidValueError("--expected", options.expected, "a whole number >= 0")
    folder = None if options.out is None else Path(options.out)
    outputs = [] if folder is None else [folder / "cable_states.csv", folder / "cables.png"]
    check_outputs((options.recording, options.arm), outputs)
    with Bag(options.recording) as bag:
        recording = read_arm_recording(bag, load_arm(options.arm))
    report = report_on(recording, options.expected)
    for write_to, file in zip((write_cable_table, write_cable_figure), outputs, strict=bool(outputs)):
        write(file, partial(write_to, recording))
    tr = translator(options.lang)
    if options.json:
        print_json(_plain(report))
    else:
        _show(report, tr)
    announce(outputs, apart=options.json, tr=tr)
    return 0


def _plain(report: KinematicReport) -> dict[str, object]:
    """Return all figures; those that are not in the recording are NaN."""
    return {**asdict(report), "n_lost": report.n_lost, "rate_disagreement_ratio": report.rate_disagreement_ratio}


def _show(report: KinematicReport, tr: Translator) -> None:
    poses = tr(
        "{count} at {rate:.1f} Hz over {duration:.1f} s",
        count=report.n_targets, rate=report.rate, duration=report.duration,
    )  # fmt: skip
    pairs = [
        (tr("poses"), poses),
        (tr("poses reached"), str(report.n_solved)),
        (tr("tip error of the reached poses"), _tip_error(report, tr)),
        (tr("cable rate against slope of length"), _rate_disagreement(report, tr)),
        (tr("messages lost"), str(report.n_lost)),
    ]
    pairs += [(tr("lost on {stream}", stream=name), str(count)) for name, count in report.lost.items() if count]
    pairs += [(tr("repeated on {stream}", stream=name), str(count)) for name, count in report.repeated.items() if count]
    print_pairs(pairs)


def _tip_error(report: KinematicReport, tr: Translator) -> str:
    if math.isnan(report.tip_error_max):
        return tr("no pose was reached")
    median, largest = 1e3 * report.tip_error_median, 1e3 * report.tip_error_max
    return tr("median {median} mm, max {largest} mm", median=rounded(median, 2), largest=rounded(largest, 2))


def _rate_disagreement(report: KinematicReport, tr: Translator) -> str:
    if math.isnan(report.rate_disagreement):
        return tr("no rates were recorded")
    return tr(
        "{difference:.3f} mm/s at worst,\n{percent:.2f} % of the largest, {largest:.1f} mm/s",
        difference=1e3 * report.rate_disagreement, percent=100 * report.rate_disagreement_ratio,
        largest=1e3 * report.largest_rate,
    )  # fmt: skip
