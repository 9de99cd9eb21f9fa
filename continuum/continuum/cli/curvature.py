"""`continuum curvature`: measured joint angles of an arm at rest, compared with constant curvature and the dynamics."""

from __future__ import annotations

import argparse
import importlib.metadata
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from continuum.cli.language_option import add_language_option
from continuum.cli.models import add_model_option, read_model
from continuum.cli.outputs import announce, check_outputs, write
from continuum.cli.recordings import add_recordings, read_recordings
from continuum.cli.tables import print_table, print_text
from continuum.errors import InvalidValueError
from continuum.identification.estimate import Z_95
from continuum.languages import ENGLISH, Message, Translator, translator
from continuum.printable import printable

if TYPE_CHECKING:
    from continuum.curvature.answer import Answer
    from continuum.curvature.comparison import Comparison, Distance

_ASSUMED = Message(
    "Intervals hold if the zeros of the sensors are right within 0.2 degrees (one standard deviation), and allow for "
    "the wander and drift that the holds show; --sensor-error states another error."
)


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "curvature", help="compare the bend of an arm at rest with two models", description=__doc__,
        epilog="Thesis chapter 4.3, Fig. 10. Exit codes: 0 done, 2 wrong usage, file or value.",
    )  # fmt: skip
    add_recordings(parser)
    add_model_option(parser, "model file of an arm with cables")
    parser.add_argument(
        "--hold",
        metavar="N",
        type=int,
        help="hold whose joint angles are printed and drawn; default: the most bent one",
    )
    parser.add_argument(
        "--sensor-error", metavar="DEG", type=float,
        help="standard deviation of the angle error common to all rows of a hold; default: 0.2 degrees at the start of "
        "the recording, increasing with the drift observed within the holds",
    )  # fmt: skip
    parser.add_argument("--csv", "--out", metavar="OUT.csv", help="write the joint angles of all holds")
    parser.add_argument("--json", metavar="OUT.json", help="write everything for machines")
    parser.add_argument("--picture", metavar="OUT.png", help="draw joint angles and backbones of one hold")
    add_language_option(parser, "tables and sentences")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Find the holds, compare, print, and write the requested files."""
    slow = options.sensor_error
    if slow is not None and not 0 <= slow < math.inf:
        raise InvalidValueError("--sensor-error", slow, "an angle >= 0 [degrees]")
    check_outputs((*options.data, options.model), [options.csv, options.json], [options.picture])
    model = read_model(options.model, options.section)
    model.require_cables("continuum curvature")
    tr = translator(options.lang)
    recordings = read_recordings(options, model, tr)
    # Here, so that files that are refused need not wait for numba.
    from continuum.curvature.answer import answer, holds_of
    from continuum.curvature.table import write_csv, write_json
    from continuum.discovery.refit import check_recordings

    check_recordings(recordings, model)
    holds = holds_of(model, recordings)
    for name in [one.name for one in recordings if all(hold.recording is not one for hold in holds)]:
        without = tr("{recording}: has no hold, and is left out", recording=printable(name))
        print(f"continuum: {without}", file=sys.stderr)
    found = answer(model, holds, None if slow is None else math.radians(slow))
    chosen = found.most_bent if options.hold is None else options.hold - 1
    if not 0 <= chosen < len(found.holds):
        raise InvalidValueError("--hold", options.hold, f"1 to {len(found.holds)}, the holds that were found")
    write(options.csv, lambda path: write_csv(found, path))
    write(options.json, lambda path: write_json(found, path, _made(options)))
    if options.picture is not None:
        from continuum.curvature.figure import write_curvature_figure

        one = found.holds[chosen]
        title = f"{one.recording.name}, {one.times[0]:.2f} to {one.times[-1]:.2f} s"
        write(options.picture, lambda path: write_curvature_figure(found.each[chosen], path, title))
    show(found, chosen, tr)
    if slow is None:
        print()
        print_text(tr(_ASSUMED))
    print()
    otherwise = tr("nothing written; --csv, --json and --picture name files")
    announce([options.csv, options.json, options.picture], otherwise, tr=tr)
    return 0


def show(found: Answer, chosen: int, tr: Translator = ENGLISH) -> None:
    """Print all holds, the joint angles of one, and which model is nearer."""
    from continuum.curvature.sentences import nearer_in_words, overall_in_words, tension_in_words

    several = len({hold.recording.name for hold in found.holds}) > 1
    headings = (
        *(tr("recording"),) * several,
        tr("hold"),
        tr("from\n[s]"),
        tr("to\n[s]"),
        tr("bend\n[deg]"),
        tr("constant\ncurvature"),
        tr("dynamic\nmodel"),
        tr("nearer"),
    )
    title = tr("Distance of each model, 95 %: above joint angles, rms [deg], below tip [mm]")
    print_table(headings, _rows(found, several, tr), title)
    hold, one = found.holds[chosen], found.each[chosen]
    print()
    headings = (
        "",
        tr("measured"),
        "2.5 %",
        "97.5 %",
        tr("constant\ncurvature"),
        tr("dynamic\nmodel"),
        tr("friction\nholds from"),
        tr("\nto"),
    )
    print_table(headings, _joints(one, tr), tr("Hold {number}, joint angles [deg]", number=chosen + 1))
    print()
    print_text(nearer_in_words(one, tr))
    print_text(tension_in_words(one, hold.tension, tr))
    if len(found.holds) > 1:
        print()
        print_text(overall_in_words(found.overall, tr))


def _rows(found: Answer, several: bool, tr: Translator) -> list[tuple[str, ...]]:
    """A row for each hold."""
    from continuum.curvature.comparison import Nearer

    names = {Nearer.DYNAMIC: tr("dynamic"), Nearer.CONSTANT: tr("constant"), Nearer.UNDECIDED: tr("undecided")}
    return [
        (
            *(printable(hold.recording.name),) * several, str(number), f"{hold.times[0]:.2f}", f"{hold.times[-1]:.2f}",
            f"{np.degrees(one.theta.sum()):.1f}", _distances(one.angles_to_constant, one.tip_to_constant),
            _distances(one.angles_to_dynamic, one.tip_to_dynamic), names[one.nearer],
        )
        for number, (hold, one) in enumerate(zip(found.holds, found.each, strict=True), start=1)
    ]  # fmt: skip


def _distances(angles: Distance, tip: Distance) -> str:
    """Each with its interval, one below the other."""
    return f"{_interval(angles, 180 / math.pi, 2)}\n{_interval(tip, 1e3, 1)}"


def _interval(one: Distance, unit: float, digits: int) -> str:
    return f"{unit * one.value:.{digits}f} +- {unit * Z_95 * one.sd:.{digits}f}"


def _joints(one: Comparison, tr: Translator) -> list[tuple[str, ...]]:
    """A row for each joint."""
    zone, low, high = one.held.zone, *one.quantiles
    angles = np.degrees([one.theta, low, high, one.constant, one.held.theta, zone.lower, zone.upper]).T
    return [
        (tr("joint {joint}", joint=j), *(f"{value:.2f}" for value in row[:5]), *(f"{value:.1f}" for value in row[5:]))
        for j, row in enumerate(angles.tolist(), start=1)
    ]


def _made(options: argparse.Namespace) -> dict[str, Any]:
    """Version and what was read, without the folders."""
    return {
        "version": importlib.metadata.version("continuum"),
        "recordings": [printable(Path(path).name) for path in options.data],
        "model": printable(Path(options.model).name),
        "sensor_error_deg": options.sensor_error,
    }
