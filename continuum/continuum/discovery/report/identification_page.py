"""The page of an identification: Table 3, Table 4 and Fig. 9 of the thesis for the given recordings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from continuum.discovery.report.chart import Axes, Chart, Line, chart, shared
from continuum.discovery.report.environment import environment
from continuum.discovery.report.figures import BEFORE, MEASURED, SMALL, TIME
from continuum.discovery.report.names import capital
from continuum.discovery.report.quantities import number, with_decimals, with_interval
from continuum.dynamics.parameters import PARAMETERS
from continuum.identification.estimate import Estimate
from continuum.identification.identified import Identified
from continuum.identification.scores import Score
from continuum.printable import one_line
from continuum.whole_file import write_whole

_IDENTIFY, _VALIDATE = "identify", "validate"


def write_identification(
    identified: Identified, predicted: Sequence[Score], fitted: Sequence[int], path: str | Path, made: str
) -> None:
    """Write the page.

    Args:
        identified: values and model.
        predicted: scores of every run.
        fitted: numbers, from 0, of the runs that values are identified from.
        path: file to write.
        made: one line on how it was made.

    Raises:
        FileError: the file cannot be written.
    """
    template = environment().get_template("identification.html")
    runs = zip(score_rows(predicted, fitted), map(_charts, predicted), strict=True)
    text = template.render(
        method=identified.method, values=value_rows(identified), runs=list(runs), fitted=len(fitted),
        validated=len(predicted) - len(fitted), remarks=list(remarks(identified, predicted, fitted)), made=made,
    )  # fmt: skip
    write_whole(path, text + "\n")


def value_rows(identified: Identified) -> list[tuple[str, str, str, str, str]]:
    """Return the rows of Table 3: name, unit, start, value and 95 % interval, in SI units."""
    return [_value(one) for one in identified.values]


def score_rows(predicted: Sequence[Score], fitted: Sequence[int]) -> list[tuple[str, str, str, str, str]]:
    """Return the rows of Table 4: run, its use, Eq. 19 of position and rate, root mean square error [degrees]."""
    rows = []
    for k, one in enumerate(predicted):
        use = _IDENTIFY if k in fitted else _VALIDATE
        error = _figure(float(np.degrees(one.rms)), 2)
        name = f"{k + 1}: {one_line(one.recording.name)}"
        rows.append((name, use, _figure(one.position, 3), _figure(one.rate, 3), error))
    return rows


def remarks(identified: Identified, predicted: Sequence[Score], fitted: Sequence[int]) -> Iterator[str]:
    """Yield what the tables say, in one or a few sentences each."""
    groups = [[one for k, one in enumerate(predicted) if (k in fitted) is used] for used in (True, False)]
    (position, rate), *others = ([_mean(group, name) for name in ("position", "rate")] for group in groups if group)
    text = f"Mean NRMSE of the runs that values are identified from: position {position}, rate {rate}"
    yield text + "".join(f"; of the runs that are predicted: {p} and {r}" for p, r in others) + "."
    if not others:
        yield "No run was kept to validate: Table 4 shows how the model fits, not how it predicts (--validate N)."
    if any(not np.isfinite(one.position) for one in predicted):
        yield "The simulation of a run failed: the identified model cannot be used for motions like it."
    if identified.error > identified.limit:
        yield (
            f"Half-second segments err by {identified.error:.3f} times the sensors' noise, more than chance allows "
            f"({identified.limit:.3f}): the fit stopped short of its optimum, or something else is wrong with the "
            "model. Values can be off by more than their intervals. `continuum diagnose` looks for a cause."
        )
    elif np.isfinite(identified.error):
        yield (
            "Half-second segments err by no more than the sensors' noise. That does not show that the rest of the "
            "model is right: an effect that it lacks can hide in these values. `continuum diagnose` looks for one."
        )
    else:
        yield "A swarm gives values without intervals, and they vary with --seed: compare the errors in Table 4."
    yield (
        "All of this holds for the masses and lengths of the model file. If only its weight drives the arm, "
        "springs, viscous and Coulomb friction are known only in proportion to the masses."
    )
    names = [name.replace("_", " ") for name in identified.undetermined]
    if names:
        yield f"These runs say little about {', '.join(names)}: the value is mostly the prior one."
    absent = [_name(one) for one in identified.values if one.start == one.value == 0]
    if absent:
        yield f"Not sought, as the model file has none: {', '.join(absent)}. Give a first value if the arm has it."
    at_bound = [_name(one) for one in identified.values if one.is_at_bound and not one.start == one.value == 0]
    if at_bound:
        yield f"At the bound of the possible range, and therefore uncertain: {', '.join(at_bound)}."


def _value(one: Estimate) -> tuple[str, str, str, str, str]:
    value, interval = with_interval(one.value, one.low, one.high)
    return _name(one), "" if one.unit == "1" else one.unit, number(one.start), value, interval


def _name(one: Estimate) -> str:
    joint = "" if one.joint is None else f" of joint {one.joint + 1}"
    return f"{capital(one.name.replace('_', ' '))} {PARAMETERS[one.name].symbol}{joint}"


def _figure(value: float, places: int) -> str:
    return with_decimals(value, places) if np.isfinite(value) else "failed"


def _mean(group: Sequence[Score], name: str) -> str:
    return _figure(float(np.mean([getattr(one, name) for one in group])), 3)


def _charts(score: Score) -> list[Chart]:
    """Return charts of the measured and predicted angles of every joint, on one scale (Fig. 9)."""
    times = score.recording.times
    axes = [
        Axes(
            f"joint {j + 1}: angle [°]", TIME,
            tuple(Line(style, times, np.degrees(angles[:, j])) for style, angles in
                  ((MEASURED, score.recording.theta), (BEFORE, score.theta))),
            0.0, (float(times[0]), float(times[-1])),
        )
        for j in range(score.recording.n_joints)
    ]  # fmt: skip
    return [chart(one, *SMALL) for one in shared(axes)]
