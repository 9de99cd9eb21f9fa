"""The answer as one self-contained page."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path

import jinja2
from matplotlib.figure import Figure

from continuum.discovery.decision import Kind
from continuum.discovery.pictures import angles, png, torques
from continuum.discovery.result import Cause, Diagnosis, Estimate
from continuum.discovery.words import (
    errors_in_words,
    estimate_in_words,
    lookalikes,
    shares_in_words,
    sigma_in_words,
    verdict_in_words,
)
from continuum.whole_file import write_whole

_TITLES = {
    Kind.ADEQUATE: "The simulation agrees with the recordings",
    Kind.UNKNOWN: "The simulation misses something, and what is unknown",
}


def write_report(result: Diagnosis, path: str | Path, made: str) -> None:
    """Write the page.

    Args:
        result: the answer.
        path: where.
        made: how it was made, one line.

    Raises:
        FileError: the file cannot be written.
    """
    template = _environment().get_template("report.html")
    page = template.render(
        kind=result.verdict.kind.value,
        title=_title(result),
        runs=", ".join(run.name for run in result.recordings),
        verdict=verdict_in_words(result),
        beware=lookalikes(result),
        notes=result.notes,
        extended=result.is_extended,
        label=_label(result.causes),
        shares=shares_in_words(result),
        errors=errors_in_words(result),
        sigma=sigma_in_words(result),
        estimates=_rows([*(one for cause in result.causes for one in cause.estimates), *result.estimates]),
        alternatives=[(_label(c), _rows([one for cause in c for one in cause.estimates])) for c in result.sets[1:]],
        angles=_image(angles(result)),
        torques=_image(torques(result)),
        made=made,
    )
    write_whole(path, page + "\n")


def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.PackageLoader(__package__), autoescape=True, trim_blocks=True, undefined=jinja2.StrictUndefined
    )


def _title(result: Diagnosis) -> str:
    if (title := _TITLES.get(result.verdict.kind)) is not None:
        return title
    return "What the simulation misses: " + " or ".join(_label(causes) for causes in result.sets)


def _label(causes: Sequence[Cause]) -> str:
    return " and ".join(cause.label for cause in causes) or "nothing"


def _rows(estimates: Sequence[Estimate]) -> list[tuple[str, str, str]]:
    return [(str(one), estimate_in_words(one), one.meaning) for one in estimates]


def _image(figure: Figure) -> str:
    return "data:image/png;base64," + base64.b64encode(png(figure)).decode()
