"""`continuum diagnose`: what a simulation gets wrong about measured data, why, and what mending it gains."""

from __future__ import annotations

import argparse
import datetime
import importlib.metadata
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from continuum.cli.completion import completes
from continuum.cli.models import add_model_option, read_model
from continuum.cli.outputs import announce, check_outputs, write
from continuum.cli.recordings import read_recordings
from continuum.cli.tables import print_pairs, print_text
from continuum.did_you_mean import did_you_mean
from continuum.dynamics.effect_lookup import effect_names
from continuum.errors import InvalidValueError
from continuum.printable import printable

if TYPE_CHECKING:
    from continuum.discovery.result import Diagnosis

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
    add_model_option(parser)
    parser.add_argument("--json", metavar="OUT.json", help="write verdict, parameters and scores for machines")
    parser.add_argument("--report", metavar="OUT.html", help="write a page with pictures that needs no other file")
    parser.add_argument(
        "--extended",
        metavar="OUT.yaml",
        help="write the extended model, for `simulate`, `diagnose` and the node `dynamics`",
    )
    parser.add_argument(
        "--tolerance", metavar="DEG", type=float,
        help="open-loop error of an adequate model, root mean square; default three times the angles' noise",
    )  # fmt: skip
    parser.add_argument(
        "--measured", metavar="NAME=VALUE", action="append", default=[],
        help="an effect's value that was measured by hand, as tip_payload.mass=50g, rest_angle.angle[3]=4+-0.5deg or "
        "inertia.mass[5]=12%% (more than in the model file); 0 where there is none; may be repeated; without +-SD as "
        "exact as the usual instrument. docs/discovery.md lists what can be given",
    )  # fmt: skip
    without = parser.add_argument(
        "--without", metavar="EFFECT", action="append", default=[],
        help="an effect that was taken off the arm for all of these recordings, as sensor_cable; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--zeroed", metavar="DATA", action="append", default=[],
        help="one of the recordings, before which the sensors' zeros were set by a protractor; may be repeated",
    )  # fmt: skip
    completes(without, lambda _: effect_names())
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Read, diagnose, print, and write what was asked for."""
    if options.tolerance is not None and not 0 < options.tolerance < math.inf:
        raise InvalidValueError("--tolerance", options.tolerance, "an angle > 0 [degrees]")
    _check_effects(options)
    check_outputs((*options.data, options.model), [options.json, options.extended], pages=[options.report])
    model, recordings = read_model(options.model, options.section), read_recordings(options.data)
    for recording in recordings:
        if recording.n_joints != model.n_joints:
            allowed = f"{model.n_joints}, as {options.model} has; --model names another"
            raise InvalidValueError(f"{recording.name}: number of joints", recording.n_joints, allowed)
    # Here, so that data that are refused need not wait for numba.
    from continuum.cli.progress import progress_bar
    from continuum.discovery import diagnose
    from continuum.discovery.hand_measurement import measurement_of
    from continuum.discovery.report import write_report
    from continuum.discovery.verdict_json import write_json
    from continuum.dynamics.model_file import save_model

    measured = [measurement_of(text) for text in options.measured]
    zeroed = [_number_of(path, options.data) for path in options.zeroed]
    tolerance = None if options.tolerance is None else math.radians(options.tolerance)
    with progress_bar() as tell:
        result = diagnose(
            recordings, model, tolerance=tolerance, progress=tell, measured=measured, zeroed=zeroed,
            without=options.without,
        )  # fmt: skip
    write(options.json, lambda path: write_json(result, path, _made(options)))
    write(options.report, lambda path: write_report(result, path, _how(options)))
    write(options.extended, lambda path: save_model(result.extended_model, path))
    show(result)  # at last: whoever reads it may stop reading
    print(f"\nof {_what(options)}")
    announce([options.json, options.report, options.extended])
    return EXIT_CODES[result.verdict.kind.value]


def _check_effects(options: argparse.Namespace) -> None:
    """Refuse an effect that there is not; of a measured value, what stands before the first dot."""
    known = effect_names()
    given = [("--without", name, name) for name in options.without]
    given += [("--measured", text, text.partition(".")[0].strip()) for text in options.measured]
    for option, text, name in given:
        if name not in known:
            near = did_you_mean(name, known) or f"; known: {', '.join(known)}"
            raise InvalidValueError(option, text, f"an effect that is installed{near}")


def _number_of(path: str, data: Sequence[str]) -> int:
    """Which of the recordings a path is."""
    paths = [Path(one).resolve() for one in data]
    if Path(path).resolve() not in paths:
        raise InvalidValueError("--zeroed", path, f"one of {', '.join(data)}")
    return paths.index(Path(path).resolve())


def _made(options: argparse.Namespace) -> dict[str, Any]:
    """How a diagnosis was made: the version, of what, without the folders, and with which options."""
    *names, model = (printable(Path(path).name) for path in (*options.data, options.model))
    version = importlib.metadata.version("continuum")
    return {
        "version": version,
        "recordings": names,
        "model": model,
        "tolerance_deg": options.tolerance,
        "measured": options.measured,
        "without": options.without,
        "zeroed": [printable(Path(path).name) for path in options.zeroed],
    }


def _what(options: argparse.Namespace) -> str:
    """Recordings and model in one line."""
    made = _made(options)
    return f"{', '.join(made['recordings'])}; model {made['model']}"


def _how(options: argparse.Namespace) -> str:
    """The same, by which version and on which day."""
    day = datetime.datetime.now().astimezone().date().isoformat()
    return f"Made on {day} by continuum {_made(options)['version']} of {_what(options)}."


def show(result: Diagnosis) -> None:
    """Print the verdict and what it rests on."""
    from continuum.discovery.decision import Kind
    from continuum.discovery.words import (
        errors_in_words,
        estimate_in_words,
        shares_in_words,
        sigma_in_words,
        similar_causes,
        verdict_in_words,
    )

    print(f"{result.verdict.kind.value.upper()}\n")
    print_text(verdict_in_words(result))
    print()
    if result.known:
        print_text(f"Also known: {'; '.join(result.known)}.")
        print()
    if result.verdict.kind is Kind.AMBIGUOUS:
        for causes, p in zip(result.sets, result.verdict.probabilities, strict=True):
            print(
                f"may be: {' and '.join(cause.label for cause in causes) or 'nothing'}   relative fit {100 * p:.0f} %"
            )
        print()
    estimates = [*(one for cause in result.causes for one in cause.estimates), *result.estimates]
    print_pairs([("parameter", "value, 95 % interval"), *((str(one), estimate_in_words(one)) for one in estimates)])
    for causes in result.sets[1:]:
        print(f"\n{' and '.join(cause.label for cause in causes)} instead:")
        print_pairs([(str(one), estimate_in_words(one)) for cause in causes for one in cause.estimates])
    if result.is_extended:
        print("\nShare of the open-loop error that is explained (95 %)")
        print_pairs(shares_in_words(result))
    models = "refitted" + " -> extended" * result.is_extended
    print(f"\nOpen-loop error, {models} model")
    print_pairs(errors_in_words(result))
    print(f"\nMissing torque, {models} model")
    print_pairs(sigma_in_words(result))
    _show_power(result)
    for line in (*result.notes, *similar_causes(result)):
        print_text(line)


def _show_power(result: Diagnosis) -> None:
    """Print what the recordings would have shown, and which run would tell more."""
    from continuum.discovery.power_words import experiment_in_words, power_in_words

    shown, hidden = power_in_words(result)
    if shown:
        print("\nSmallest size that these recordings would have shown (in 80 of 100 cases)")
        print_pairs(shown)
    if hidden:
        print("\nNot to be seen in them at its typical size")
        print_pairs(hidden)
    if text := experiment_in_words(result):
        print()
        print_text(f"Next experiment: {text}")
    print()
