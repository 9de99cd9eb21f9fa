"""The page of an identification: Table 3, Table 4 and Fig. 9 of the thesis for the given recordings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from continuum.discovery.report.chart import Axes, Chart, Line, chart, shared
from continuum.discovery.report.environment import environment
from continuum.discovery.report.figures import ANGLE, BEFORE, MEASURED, SMALL, TIME, title
from continuum.discovery.report.names import capital, parameter_in_words
from continuum.discovery.report.quantities import number, with_decimals, with_interval
from continuum.dynamics.parameters import PARAMETERS
from continuum.identification.estimate import Estimate
from continuum.identification.identified import Identified
from continuum.identification.scores import Score
from continuum.languages import ENGLISH, Message, Translator
from continuum.printable import one_line
from continuum.significant_digits import rounded
from continuum.whole_file import write_whole

_IDENTIFY, _VALIDATE = Message("identify"), Message("validate")


def write_identification(
    identified: Identified,
    predicted: Sequence[Score],
    fitted: Sequence[int],
    path: str | Path,
    made: str,
    tr: Translator = ENGLISH,
) -> None:
    """Write the page.

    Args:
        identified: values and model.
        predicted: scores of every run.
        fitted: numbers, from 0, of the runs that values are identified from.
        path: file to write.
        made: one line on how it was made.
        tr: to the language of the page.

    Raises:
        FileError: the file cannot be written.
    """
    template = environment(tr).get_template("identification.html")
    runs = [(row, _charts(one, tr)) for row, one in zip(score_rows(predicted, fitted, tr), predicted, strict=True)]
    text = template.render(
        method=tr(identified.method), values=value_rows(identified, tr), runs=runs, fitted=len(fitted),
        validated=len(predicted) - len(fitted), remarks=list(remarks(identified, predicted, fitted, tr)), made=made,
    )  # fmt: skip
    write_whole(path, text + "\n")


def value_rows(identified: Identified, tr: Translator = ENGLISH) -> list[tuple[str, str, str, str, str]]:
    """Return the rows of Table 3: name, unit, start, value and 95 % interval, in SI units."""
    return [_value(one, tr) for one in identified.values]


def score_rows(
    predicted: Sequence[Score], fitted: Sequence[int], tr: Translator = ENGLISH
) -> list[tuple[str, str, str, str, str]]:
    """Return the rows of Table 4: run, its use, Eq. 19 of position and rate, root mean square error [degrees]."""
    rows = []
    for k, one in enumerate(predicted):
        use = tr(_IDENTIFY if k in fitted else _VALIDATE)
        error = _figure(float(np.degrees(one.rms)), 2, tr)
        name = f"{k + 1}: {one_line(one.recording.name)}"
        rows.append((name, use, _figure(one.position, 3, tr), _figure(one.rate, 3, tr), error))
    return rows


def remarks(
    identified: Identified, predicted: Sequence[Score], fitted: Sequence[int], tr: Translator = ENGLISH
) -> Iterator[str]:
    """Yield what the tables say, in one or a few sentences each."""
    used, others = ([one for k, one in enumerate(predicted) if (k in fitted) is kept] for kept in (True, False))
    means = {"position": _mean(used, "position", tr), "rate": _mean(used, "rate", tr)}
    if others:
        predictions = {"predicted": _mean(others, "position", tr), "predicted_rate": _mean(others, "rate", tr)}
        yield tr(
            "Mean NRMSE, identification recordings: position {position}, rate {rate}; validation recordings: position "
            "{predicted}, rate {predicted_rate}.",
            **means, **predictions,
        )  # fmt: skip
    else:
        yield tr("Mean NRMSE, identification recordings: position {position}, rate {rate}.", **means)
        yield tr(
            "No recording was kept for validation: Table 4 shows the fit of the model, not its predictions "
            "(--validate N)."
        )
    if any(not np.isfinite(one.position) for one in predicted):
        yield tr("The simulation of a recording failed: the identified model is unusable for similar motions.")
    if identified.error > identified.limit:
        yield tr(
            "Half-second segments err by {error} times the sensors' noise, more than chance allows ({limit:.3f}): "
            "the fit stopped short of its optimum, or something else is wrong with the model. Values can be off by "
            "more than their intervals. `continuum diagnose` looks for a cause.",
            error=rounded(identified.error, 4 if identified.error < 10 else 3), limit=identified.limit,
        )  # fmt: skip
    elif np.isfinite(identified.error):
        yield tr(
            "Half-second segments err by no more than the sensors' noise. That does not show that the rest of the "
            "model is right: an effect that it lacks can hide in these values. `continuum diagnose` looks for one."
        )
    else:
        yield tr("A swarm gives values without intervals, and they vary with --seed: compare the errors in Table 4.")
    yield tr(
        "All of this holds for the masses and lengths of the model file. If only its weight drives the arm, "
        "springs, viscous and Coulomb friction are known only in proportion to the masses."
    )
    if names := ", ".join(parameter_in_words(name, tr=tr) for name in identified.undetermined):
        yield tr(
            "These recordings contain little information on {parameters}: mostly the prior value.", parameters=names
        )
    if names := ", ".join(_name(one, tr) for one in identified.values if one.start == one.value == 0):
        yield tr(
            "Not sought, as the model file has none: {parameters}. Give a first value if the arm has it.",
            parameters=names,
        )
    at_bound = [one for one in identified.values if one.is_at_bound and not one.start == one.value == 0]
    if names := ", ".join(_name(one, tr) for one in at_bound):
        yield tr("At the bound of the possible range, and therefore uncertain: {parameters}.", parameters=names)


def _value(one: Estimate, tr: Translator) -> tuple[str, str, str, str, str]:
    value, interval = with_interval(one.value, one.low, one.high, tr)
    return _name(one, tr), "" if one.unit == "1" else one.unit, number(one.start), value, interval


def _name(one: Estimate, tr: Translator) -> str:
    name = f"{capital(parameter_in_words(one.name, tr=tr))} {PARAMETERS[one.name].symbol}"
    return name if one.joint is None else tr("{parameter} of joint {joint}", parameter=name, joint=one.joint + 1)


def _figure(value: float, places: int, tr: Translator) -> str:
    return with_decimals(value, places) if np.isfinite(value) else tr("failed")


def _mean(group: Sequence[Score], name: str, tr: Translator) -> str:
    return _figure(float(np.mean([getattr(one, name) for one in group])), 3, tr)


def _charts(score: Score, tr: Translator) -> list[Chart]:
    """Return charts of the measured and predicted angles of every joint, on one scale (Fig. 9)."""
    times = score.recording.times
    axes = [
        Axes(
            title(j, ANGLE, tr), tr(TIME),
            tuple(Line(style, times, np.degrees(angles[:, j])) for style, angles in
                  ((MEASURED, score.recording.theta), (BEFORE, score.theta))),
            0.0, (float(times[0]), float(times[-1])),
        )
        for j in range(score.recording.n_joints)
    ]  # fmt: skip
    return [chart(one, *SMALL) for one in shared(axes)]
