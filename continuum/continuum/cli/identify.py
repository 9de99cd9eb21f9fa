"""`continuum identify`: identify springs and friction from recordings, and predict other recordings with them."""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from continuum.cli.language_option import add_language_option
from continuum.cli.models import add_model_option, read_model
from continuum.cli.outputs import announce, check_outputs, write
from continuum.cli.recordings import add_recordings, read_recordings
from continuum.cli.tables import print_pairs, print_table, print_text
from continuum.errors import InvalidValueError
from continuum.languages import ENGLISH, Translator, translator
from continuum.printable import printable

if TYPE_CHECKING:
    from continuum.dynamics.model import Model
    from continuum.identification.identified import Identified
    from continuum.identification.scores import Score
    from continuum.recordings.recording import Recording


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "identify", help="identify springs and friction from recordings, and predict others", description=__doc__,
        epilog="Thesis chapters 3.3 and 4.2: Table 3 (values), Table 4 (NRMSE of every recording, Eq. 19), Fig. 9 "
        "(--report). Exit codes: 0 done, 2 wrong usage, file or value.",
    )  # fmt: skip
    add_recordings(parser)
    add_model_option(parser, "model file with masses, lengths and start values")
    parser.add_argument(
        "--method", choices=("fit", "swarm"), default="fit",
        help="fit: maximum likelihood of open-loop simulations, with intervals; swarm: the thesis's particle swarm "
        "(Table 2), which lowers Eq. 19 of the rates; default %(default)s",
    )  # fmt: skip
    parser.add_argument(
        "--identify", metavar="N,N,..", help="recordings to identify from, by number from 1; default all, or those "
        "that --validate does not name",
    )  # fmt: skip
    parser.add_argument(
        "--validate", metavar="N,N,..", help="recordings to predict only; default those that --identify does not name"
    )
    parser.add_argument(
        "--per-joint", action="store_true",
        help="identify stiffness, viscous and Coulomb friction of every joint; otherwise one value for all joints",
    )  # fmt: skip
    parser.add_argument("--seed", metavar="N", type=int, help="seed for --method swarm; default 0")
    parser.add_argument("--out", metavar="MODEL.yaml", help="write the model with the identified values")
    parser.add_argument(
        "--report", metavar="PAGE.html", help="write a page with both tables and the angles of every recording"
    )
    add_language_option(parser, "tables and page")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Identify, predict, print, and write the requested files."""
    from continuum.dynamics.model import with_dry_friction
    from continuum.dynamics.model_file import save_model
    from continuum.identification.scores import scores

    check_outputs((*options.data, options.model), [options.out], pages=[options.report])
    if options.seed is not None and options.method != "swarm":
        raise InvalidValueError("--seed", options.seed, "only with --method swarm")
    if options.seed is not None and options.seed < 0:
        raise InvalidValueError("--seed", options.seed, "a whole number >= 0")
    fitted = chosen_runs(options.identify, options.validate, len(options.data))
    tr = translator(options.lang)
    model = read_model(options.model, options.section)
    recordings = read_recordings(options, model, tr)
    from continuum.discovery.refit import check_recordings  # here, so that what is refused need not wait for numba

    check_recordings(recordings, model)
    began = time.process_time()
    identified = _identified(options, [recordings[k] for k in fitted], model, tr)
    seconds = time.process_time() - began
    predicted = scores(identified.model, recordings)
    write(options.out, lambda path: save_model(with_dry_friction(identified.model), path))  # the model that is scored
    if options.report is not None:
        from continuum.discovery.report.identification_page import write_identification

        made = _made(options, seconds, tr)
        write(options.report, lambda path: write_identification(identified, predicted, fitted, path, made, tr))
    show(identified, predicted, fitted, tr)
    print_pairs([(tr("method"), tr(identified.method)), (tr("processor time"), f"{seconds:.1f} s")])
    announce([options.out, options.report], tr("nothing written; --out names a model file"), tr=tr)
    return 0


def chosen_runs(identify: str | None, validate: str | None, n_runs: int) -> list[int]:
    """Runs that values are identified from, counted from 0; the others are predicted.

    Args:
        identify, validate: run numbers from 1 with commas between them; None leaves the choice to the other one.
        n_runs: how many there are.

    Raises:
        InvalidValueError: no such run, one twice or in both, one in neither, or none to identify from.
    """
    if validate is not None and n_runs < 2:
        raise InvalidValueError("number of runs", n_runs, "two or more with --validate, one of them to identify from")
    numbers = {}
    for option, text in (("--identify", identify), ("--validate", validate)):
        if text is not None:
            numbers[option] = _numbers(option, text, n_runs)
    if not numbers:
        return [*range(n_runs)]
    everything, predicted = {*range(n_runs)}, numbers.get("--validate", [])
    fitted = numbers.get("--identify", sorted(everything - {*predicted}))
    if not fitted:
        raise InvalidValueError("--validate", validate, f"fewer than all {n_runs} runs: one or more to identify from")
    if both := {*fitted} & {*predicted}:
        raise InvalidValueError("--validate", validate, f"none of --identify {identify}, as run {min(both) + 1} is")
    if validate is not None and (rest := everything - {*fitted, *predicted}):
        raise InvalidValueError("--validate", validate, f"every run that --identify leaves, as run {min(rest) + 1}")
    return fitted


def _numbers(option: str, text: str, n_runs: int) -> list[int]:
    """Runs, from 0."""
    parts = [part.strip() for part in text.split(",")]
    numbers = [int(part) - 1 if part.isascii() and part.isdigit() else -1 for part in parts]
    if len({*numbers}) < len(numbers) or not {*numbers} <= {*range(n_runs)}:
        allowed = (
            f"numbers from 1 to {n_runs}, as many runs are given, each once" if n_runs > 1 else "1: one run is given"
        )
        raise InvalidValueError(option, text, allowed)
    return numbers


def _identified(
    options: argparse.Namespace, recordings: Sequence[Recording], model: Model, tr: Translator
) -> Identified:
    """By the method that was asked for."""
    from continuum.cli.progress import progress_bar

    with progress_bar(tr) as tell:
        if options.method == "swarm":
            from continuum.identification.thesis_swarm import swarm_parameters

            return swarm_parameters(recordings, model, options.seed or 0, options.per_joint, tell)
        from continuum.discovery.parameter_fit import fit_parameters

        return fit_parameters(recordings, model, options.per_joint, tell)


def show(identified: Identified, predicted: Sequence[Score], fitted: Sequence[int], tr: Translator = ENGLISH) -> None:
    """Print Table 3, Table 4 and what they say."""
    from continuum.discovery.report.identification_page import remarks, score_rows, value_rows

    headings = tr("Table 3"), tr("unit"), tr("start"), tr("value"), tr("95 % interval")
    print_table(headings, value_rows(identified, tr))
    print()
    headings = tr("Table 4"), tr("use"), tr("position NRMSE"), tr("rate NRMSE"), tr("RMSE [deg]")
    print_table(headings, score_rows(predicted, fitted, tr))
    print()
    for line in remarks(identified, predicted, fitted, tr):
        print_text(line)


def _made(options: argparse.Namespace, seconds: float, tr: Translator) -> str:
    """How the page was made, one line."""
    import importlib.metadata

    version, model = importlib.metadata.version("continuum"), printable(Path(options.model).name)
    return tr(
        "Made by continuum {version} with model {model}; {seconds:.1f} s of processor time.",
        version=version, model=model, seconds=seconds,
    )  # fmt: skip
