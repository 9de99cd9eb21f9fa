"""`continuum diagnose`: what a simulation gets wrong about measured data, why, and what mending it gains."""

from __future__ import annotations

import argparse
import datetime
import importlib.metadata
import math
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from continuum.cli.output_files import check_apart, check_writable
from continuum.cli.sensor_options import (
    add_sensor_options,
    given_sensor_options,
    sensor_knowledge,
    unused_sensor_options,
)
from continuum.cli.tables import print_pairs
from continuum.printable import printable

if TYPE_CHECKING:
    from continuum.discovery.diagnose import Diagnosis
    from continuum.discovery.findings import Estimate, Findings
    from continuum.dynamics.model import Model
    from continuum.identification.noise import SensorKnowledge
    from continuum.recordings.recording import Recording

EXIT_CODES = {"adequate": 0, "cause": 3, "ambiguous": 4, "unknown": 5}  # 1 is a crash, 2 wrong usage


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "diagnose", help="what a simulation gets wrong about recordings, and why", description=__doc__,
        epilog="Exit codes: 0 adequate, 3 a cause is named, 4 ambiguous, 5 unknown; 2 wrong usage or data, 130 Ctrl-C.",
    )  # fmt: skip
    parser.add_argument(
        "data", metavar="DATA", nargs="+", help="recordings: CSV files (t_s,q1_deg,..) or rosbag2 folders"
    )
    parser.add_argument(
        "--model", metavar="FILE.yaml", default="lamecc_prototype.yaml",
        help="model file, or one that comes with the library; default %(default)s",
    )  # fmt: skip
    parser.add_argument("--json", metavar="OUT.json", help="write verdict, parameters and scores for machines")
    parser.add_argument("--report", metavar="OUT.html", help="write a page with pictures that needs no other file")
    parser.add_argument(
        "--extended",
        metavar="OUT.yaml",
        help="write the extended model, for `simulate`, `diagnose` and the node `dynamics`",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of the intervals; default %(default)s")
    parser.add_argument("--processes", metavar="N", type=int, help="that work at once; default one for each core")
    add_sensor_options(parser)
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Read, diagnose, print, and write what was asked for."""
    from continuum.dynamics.model_file import load_model

    for path in (options.json, options.report, options.extended):
        check_writable(path)
    check_apart((options.json, options.report, options.extended), (*options.data, options.model))
    known = sensor_knowledge(options)
    model, recordings = load_model(options.model), [read_recording(path) for path in options.data]
    for recording in recordings:
        for note in recording.notes:  # before minutes pass: what was not understood may be what matters
            print(f"continuum: {printable(recording.name)}: {printable(note)}", file=sys.stderr)
    for name in unused_sensor_options(options, all(recording.theta_rate is not None for recording in recordings)):
        print(f"continuum: {name} has no effect on these recordings", file=sys.stderr)
    return _diagnose(options, model, recordings, known)


def _diagnose(
    options: argparse.Namespace, model: Model, recordings: Sequence[Recording], known: SensorKnowledge
) -> int:
    # Here, so that the other commands, and data that are refused, need not wait for numba.
    from continuum.cli.progress import told
    from continuum.discovery.answer import answer
    from continuum.discovery.verdict_json import write_json
    from continuum.dynamics.model_file import save_model
    from continuum.identification.dataset import Dataset

    with told() as tell:
        diagnosis, found = answer(Dataset(tuple(recordings)), model, options.seed, options.processes, tell, known=known)
    show(found)
    if options.json is not None:
        write_json(found, options.json, _made(options))
    if options.report is not None:
        _report(options, diagnosis, found)
    if options.extended is not None:
        save_model(found.model, options.extended)
    return EXIT_CODES[found.verdict.kind.value]


def _report(options: argparse.Namespace, diagnosis: Diagnosis, found: Findings) -> None:
    import numpy as np

    from continuum.discovery.report_html import write_report
    from continuum.discovery.residual_torque import residual_torques
    from continuum.discovery.structure_tests import structure_tests

    before = residual_torques(diagnosis.question, [found.refitted] * len(found.models))
    after = residual_torques(diagnosis.question, found.models) if found.verdict.extension else None
    tests = structure_tests(before, np.random.default_rng(options.seed))
    write_report(options.report, diagnosis, found, (before, after), tests, _how(options))


def _made(options: argparse.Namespace) -> dict[str, Any]:
    """How a diagnosis was made: the version, of what, without the folders, and with which options."""
    *names, model = (printable(Path(path).name) for path in (*options.data, options.model))
    sensors = given_sensor_options(options)
    version = importlib.metadata.version("continuum")
    return {"version": version, "recordings": names, "model": model, "seed": options.seed, "sensors": sensors}


def _how(options: argparse.Namespace) -> str:
    """The same in one line, and on which day."""
    made, day = _made(options), datetime.datetime.now().astimezone().date().isoformat()
    sensors = "".join(f", {name} {value:g}" for name, value in made["sensors"].items())
    what = f"{', '.join(made['recordings'])}; model {made['model']}, seed {made['seed']}{sensors}"
    return f"Made on {day} by continuum {made['version']} of {what}."


def read_recording(path: str) -> Recording:
    """One run from a CSV file or the folder of a rosbag2 recording."""
    from continuum.recordings.recording_bag import read_recording_bag
    from continuum.recordings.recording_csv import read_recording_csv

    return read_recording_bag(path) if Path(path).is_dir() else read_recording_csv(path)


def show(found: Findings) -> None:
    """Print the verdict and what it rests on."""
    from continuum.discovery.in_words import (
        RATE_IN_WORDS,
        cost_in_words,
        identifiability_in_words,
        other_in_words,
        scores_in_words,
        verdict_in_words,
        worth_in_words,
    )
    from continuum.discovery.verdict import Kind

    verdict = found.verdict
    print(f"{verdict.kind.value.upper()}\n\n{verdict_in_words(verdict)}\n")
    if verdict.kind is not Kind.UNKNOWN:
        named = "may be" if verdict.kind is Kind.AMBIGUOUS else "cause"
        for title, causes in ((named, verdict.causes), ("may be", verdict.alternatives)):
            for cause in causes:
                print(f"{title}: {cause.addition}   confidence {cause.confidence:.2f}")
    print_pairs([("parameter", "value, 95 % interval"), *(_estimate(one) for one in found.estimates)])
    for cause, own in zip(verdict.alternatives, found.others, strict=True):
        print(f"\n{cause.addition} instead:")
        print_pairs([_estimate(one) for one in own])
    print("", *identifiability_in_words(found.identifiability), sep="\n")
    scores = [(b.name, scores_in_words(b), scores_in_words(a)) for b, a in zip(found.before, found.after, strict=True)]
    models = "refitted" + " -> extended" * bool(verdict.extension)
    measured = all(score.recording.theta_rate is not None for score in found.before)
    for what, words in (("position", "position"), ("rate", RATE_IN_WORDS[measured])):
        print(f"\n{words.capitalize()}: Eq. 19 (95 %) on runs that were held out, {models} model")
        print_pairs([(name, once[what] + f" -> {now[what]}" * bool(verdict.extension)) for name, once, now in scores])
    if verdict.extension:
        print(f"{worth_in_words(found.closed)}; {cost_in_words(found.before, found.after)}.")
    if found.other:
        print(f"{other_in_words(found.other.addition, found.other.closed)}.")
    for line in (*found.notes, *([f"Mind: {found.weakness}."] if found.weakness else [])):
        print(line)


def _estimate(one: Estimate) -> tuple[str, str]:
    """Name, and value with interval."""
    value = f"{one.value:.4g} ({one.low:.4g} to {one.high:.4g})" + f" {one.unit}" * (one.unit != "1")
    degrees = f" = {math.degrees(one.value):.3g} degrees" if one.unit == "rad" else ""
    limit = ", at the limit" if one.at_limit else ""
    return str(one.unknown), f"{value}{degrees}{limit}"
