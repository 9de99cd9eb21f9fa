"""`continuum diagnose`: what a simulation gets wrong about recordings, why, and how much a correction improves it."""

from __future__ import annotations

import argparse
import datetime
import importlib.metadata
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from continuum.cli.before_after import before_after_command
from continuum.cli.completion import completes
from continuum.cli.language_option import add_language_option
from continuum.cli.models import add_model_option, read_model
from continuum.cli.outputs import announce, check_outputs, write
from continuum.cli.recordings import add_recordings, bag_words, read_recordings
from continuum.cli.tables import print_pairs, print_text
from continuum.did_you_mean import did_you_mean
from continuum.dynamics.effect_lookup import effect_names
from continuum.errors import InvalidValueError
from continuum.languages import ENGLISH, Message, Translator, translator
from continuum.printable import printable

if TYPE_CHECKING:
    from continuum.discovery.result import Cause, Diagnosis

EXIT_CODES = {"adequate": 0, "cause": 3, "ambiguous": 4, "unknown": 5}  # 1 is a crash, 2 wrong usage
_VERDICTS = {
    "adequate": Message("ADEQUATE"),
    "cause": Message("CAUSE"),
    "ambiguous": Message("AMBIGUOUS"),
    "unknown": Message("UNKNOWN"),
}


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "diagnose", help="find what a simulation gets wrong about recordings, and why", description=__doc__,
        epilog="Exit codes: 0 adequate, 3 a cause is named, 4 ambiguous, 5 unknown; 2 wrong usage or data, 130 Ctrl-C.",
    )  # fmt: skip
    add_recordings(parser)
    add_model_option(parser)
    parser.add_argument("--json", metavar="OUT.json", help="write verdict, parameters and scores for machines")
    parser.add_argument("--report", metavar="OUT.html", help="write a self-contained page with charts")
    parser.add_argument(
        "--extended",
        metavar="OUT.yaml",
        help="write the extended model, for `simulate`, `diagnose` and the node `dynamics`",
    )
    parser.add_argument(
        "--tolerance", metavar="DEG", type=float,
        help="largest open-loop error of an adequate model, root mean square; default three times the angles' noise",
    )  # fmt: skip
    parser.add_argument(
        "--measured", metavar="NAME=VALUE", action="append", default=[],
        help="value of an effect measured by hand, as tip_payload.mass=50g, rest_angle.angle[3]=4+-0.5deg or "
        "inertia.mass[5]=12%% (more than in the model file); 0 means that the effect is absent. Without +-SD, the "
        "standard deviation of the usual instrument is assumed. May be repeated. docs/discovery.md lists the values",
    )  # fmt: skip
    without = parser.add_argument(
        "--without", metavar="EFFECT", action="append", default=[],
        help="effect that was removed from the arm for all of these recordings, as sensor_cable; may be repeated",
    )  # fmt: skip
    parser.add_argument(
        "--zeroed", metavar="RECORDING", action="append", default=[],
        help="one of the recordings, before which the zeros of the sensors were set with a protractor; may be repeated",
    )  # fmt: skip
    completes(without, lambda _: effect_names())
    add_language_option(parser, "verdict and page")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Read, diagnose, print, and write the requested files."""
    if options.tolerance is not None and not 0 < options.tolerance < math.inf:
        raise InvalidValueError("--tolerance", options.tolerance, "an angle > 0 [degrees]")
    _check_effects(options)
    check_outputs((*options.data, options.model), [options.json, options.extended], pages=[options.report])
    tr = translator(options.lang)
    model = read_model(options.model, options.section)
    recordings = read_recordings(options, model, tr)
    for recording in recordings:
        if recording.n_joints != model.n_joints:
            allowed = f"{model.n_joints}, as {options.model} has; --model names another"
            raise InvalidValueError(f"{recording.name}: number of joints", recording.n_joints, allowed)
    # Imported here, so that rejected data need not wait for numba.
    from continuum.cli.progress import progress_bar
    from continuum.discovery import diagnose
    from continuum.discovery.hand_measurement import measurement_of
    from continuum.discovery.report import write_report
    from continuum.discovery.verdict_json import write_json
    from continuum.dynamics.model_file import save_model

    measured = [measurement_of(text) for text in options.measured]
    zeroed = [_number_of(path, options.data) for path in options.zeroed]
    tolerance = None if options.tolerance is None else math.radians(options.tolerance)
    with progress_bar(tr) as tell:
        result = diagnose(
            recordings, model, tolerance=tolerance, progress=tell, measured=measured, zeroed=zeroed,
            without=options.without,
        )  # fmt: skip
    write(options.json, lambda path: write_json(result, path, _made(options)))
    write(options.report, lambda path: write_report(result, path, _how(options, tr), tr))
    write(options.extended, lambda path: save_model(result.extended_model, path))
    show(result, tr)  # last, as a reader may close the pipe
    print()
    print(tr("Recordings: {recordings}. Model: {model}.", **_inputs(options)))
    announce([options.json, options.report, options.extended], tr=tr)
    if options.extended is not None:
        shown = before_after_command(
            options.data[0], options.model, options.section, options.extended, bag_words(options)
        )
        print(tr("see before and after: {command}", command=printable(shown)))
    return EXIT_CODES[result.verdict.kind.value]


def _check_effects(options: argparse.Namespace) -> None:
    """Check that each effect exists; that of a measured value is the text before the first dot."""
    known = effect_names()
    given = [("--without", name, name) for name in options.without]
    given += [("--measured", text, text.partition(".")[0].strip()) for text in options.measured]
    for option, text, name in given:
        if name not in known:
            near = did_you_mean(name, known) or f"; known: {', '.join(known)}"
            raise InvalidValueError(option, text, f"an effect that is installed{near}")


def _number_of(path: str, data: Sequence[str]) -> int:
    """Return the index of the recording with this path."""
    paths = [Path(one).resolve() for one in data]
    if Path(path).resolve() not in paths:
        raise InvalidValueError("--zeroed", path, f"one of {', '.join(data)}")
    return paths.index(Path(path).resolve())


def _made(options: argparse.Namespace) -> dict[str, Any]:
    """Return how a diagnosis was made: version, options, and the names of its files without their folders."""
    *names, model = (printable(Path(path).name) for path in (*options.data, options.model))
    version = importlib.metadata.version("continuum")
    return {
        "version": version,
        "recordings": names,
        "model": model,
        "section": options.section,
        "tolerance_deg": options.tolerance,
        "measured": options.measured,
        "without": options.without,
        "zeroed": [printable(Path(path).name) for path in options.zeroed],
    }


def _inputs(options: argparse.Namespace) -> dict[str, str]:
    """Return the names of the recordings and of the model."""
    made = _made(options)
    return {"recordings": ", ".join(made["recordings"]), "model": made["model"]}


def _how(options: argparse.Namespace, tr: Translator) -> str:
    """Return date, version, recordings and model in words."""
    day, version = datetime.datetime.now().astimezone().date().isoformat(), _made(options)["version"]
    return tr(
        "Made on {day} by continuum {version}. Recordings: {recordings}. Model: {model}.",
        day=day, version=version, **_inputs(options),
    )  # fmt: skip


def show(result: Diagnosis, tr: Translator = ENGLISH) -> None:
    """Print the verdict and the results that it is based on."""
    from continuum.discovery.decision import Kind
    from continuum.discovery.report.quantities import tenths
    from continuum.discovery.words import (
        errors_in_words,
        estimate_in_words,
        estimate_name,
        known_in_words,
        shares_in_words,
        sigma_in_words,
        similar_causes,
        verdict_in_words,
    )

    print(f"{tr(_VERDICTS[result.verdict.kind.value])}\n")
    print_text(verdict_in_words(result, tr))
    print()
    if result.known:
        print_text(known_in_words(result, tr))
        print()
    if result.verdict.kind is Kind.AMBIGUOUS:
        for causes, p in zip(result.sets, result.verdict.relative_fits, strict=True):
            fit = tenths(p, tr)
            print(tr("may be: {effects}   relative fit {percent} %", effects=_labels(causes, tr), percent=fit))
        print()
    estimates = [*(one for cause in result.causes for one in cause.estimates), *result.estimates]
    headings = tr("parameter"), tr("value, 95 % interval")
    print_pairs([headings, *((estimate_name(one, tr), estimate_in_words(one, tr)) for one in estimates)])
    for causes in result.sets[1:]:
        _print_heading(tr("{effects} instead:", effects=_labels(causes, tr)))
        print_pairs(
            [(estimate_name(one, tr), estimate_in_words(one, tr)) for cause in causes for one in cause.estimates]
        )
    if result.is_extended:
        _print_heading(tr("Share of the open-loop error that is explained (95 %)"))
        print_pairs(shares_in_words(result, tr))
    both = result.is_extended
    _print_heading(tr("Open-loop error, refitted -> extended model") if both else tr("Open-loop error, refitted model"))
    print_pairs(errors_in_words(result, tr))
    _print_heading(tr("Missing torque, refitted -> extended model") if both else tr("Missing torque, refitted model"))
    print_pairs(sigma_in_words(result, tr))
    _show_power(result, tr)
    for line in (*map(tr, result.notes), *similar_causes(result, tr)):
        print_text(line)


def _print_heading(text: str) -> None:
    """Print a line below a blank one."""
    print(f"\n{text}")


def _labels(causes: Sequence[Cause], tr: Translator) -> str:
    """Return the effects of a set by their names in model files."""
    return tr(" and ").join(cause.label for cause in causes) or tr("nothing")


def _show_power(result: Diagnosis, tr: Translator) -> None:
    """Print which effects the recordings would have shown, and the next experiment."""
    from continuum.discovery.power_words import experiment_in_words, power_in_words

    shown, hidden = power_in_words(result, tr)
    if shown:
        _print_heading(tr("Smallest size that these recordings would have shown (in 80 of 100 cases)"))
        print_pairs(shown)
    if hidden:
        _print_heading(tr("Effects that these recordings cannot show at their typical size"))
        print_pairs(hidden)
    if text := experiment_in_words(result, tr):
        print()
        print_text(tr("Next experiment: {experiment}", experiment=text))
    print()
