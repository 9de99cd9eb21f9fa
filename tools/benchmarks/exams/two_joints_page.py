"""Section of the page on the arm with two joints: a row for every diagnosis, its drive torques, and its prediction."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import degrees

import numpy as np

from continuum.discovery.result import Diagnosis, is_named
from tools.benchmarks.exams.exam_section import Section
from tools.benchmarks.exams.pendulum_prediction import WINDOW, Error, Prediction
from tools.benchmarks.exams.pendulum_runs import GIVEN, MEASURED, WITHHELD
from tools.benchmarks.exams.pendulum_torques import TorqueChoice, difference
from tools.benchmarks.exams.two_joints import ALTERED, EXTENDED, LAG, MAKERS, TURN, Answers
from tools.benchmarks.exams.two_joints_values import friction, halved, late, turned
from tools.benchmarks.record import Figure
from tools.docs.markdown import paragraph, table


def section(found: Answers) -> Section:
    """Return the section of the exam."""
    parts = [
        "## A real arm of two joints that torques drive",
        _cases(found),
        friction(found.first),
        _torques(found.choices),
        _prediction(found),
        _missing(found.first),
        halved(found.halved),
        turned(found.first, found.offset),
        late(found.late),
    ]
    return Section("\n\n".join(parts), tuple(_figures(found.predictions)))


def _figures(predictions: Mapping[str, Prediction]) -> Iterator[Figure]:
    """Yield figures of the unseen run, by the extended model and by the one with its makers' friction."""
    ours, makers = predictions[EXTENDED], predictions[MAKERS]
    for what, one, other in (
        (f"windows of {WINDOW:g} s", ours.windows, makers.windows),
        ("whole run", ours.whole, makers.whole),
    ):
        name = f"double pendulum, a run that was not given, {what}: NRMSE"
        yield Figure(name, one.nrmse, rival=MAKERS, rival_value=other.nrmse)


def _cases(found: Answers) -> str:
    given = ", ".join(GIVEN)
    cases = {
        ("nominal, without friction", given): found.first,
        ("extended, half of the last mass", given): found.halved,
        ("extended", f"{given}; {TURN:g} degrees added to q{ALTERED + 1} of {GIVEN[0]}"): found.offset,
        ("extended", f"{given}; q{ALTERED + 1} of both {1e3 * LAG:g} ms late"): found.late,
    }
    rows = []
    for (model, data), one in cases.items():
        errors = " -> ".join(f"{degrees(each.of_segments):.2f}" for each in (one.before, one.after))
        more = "no" if one.verdict.complete else "yes"
        rows.append((model, data, f"`{one.verdict.kind.value}`", _sets(one), errors, more, f"{one.seconds:.0f}"))
    text = paragraph(
        "The double pendulum of the DFKI (data/double_pendulum) was excited for 10 s in each run. Torques are those of",
        "the motors' currents unless another is named. *Extended* is the model that the first diagnosis gives. Errors",
        "are those of open-loop simulations of half a second, of the refitted and of the extended model. *More* says",
        "whether the diagnosis finds that something else is missing too. Times are the processor's.",
        "The last three cases diagnose the recordings that the extended model was fitted to: they show whether an",
        "alteration is found, not whether that model is right.",
    )
    head = ("model", "recordings", "verdict", "sets (relative fit)", "error [deg]", "more", "time [s]")
    return f"{text}\n\n{table(head, rows)}"


def _sets(one: Diagnosis) -> str:
    names = [" + ".join(cause.label for cause in causes) or "nothing" for causes in one.sets]
    if not is_named(one.verdict.kind):
        return f"none; {names[0]} helps most" if names else "none"
    return "; ".join(f"{name} ({p:.2f})" for name, p in zip(names, one.verdict.relative_fits, strict=True))


def _torques(choices: Sequence[TorqueChoice]) -> str:
    first, *others = sorted(choices, key=lambda one: one.best.error)
    rows, farther = [], []
    for one in (first, *others):
        best, fits = one.best, [degrees(fit.error) for fit in one.fits]
        compared = ["", ""]
        if one is not first:
            d = difference(one, first)
            compared = [f"{d.log_likelihood:.1f} ({d.low:.1f} to {d.high:.1f})", f"{d.by_start:.1f}"]
            farther += [] if d.is_chance else [" / ".join(one.torques)]
        rows.append([
            *one.torques, f"{degrees(best.error):.3f}", f"{min(fits):.3f} to {max(fits):.3f}", best.label,
            "held" if best.held else "linear", f"{best.independent:.0f}", *compared, f"{one.seconds:.0f}",
        ])  # fmt: skip
    head = (
        "joint 1", "joint 2", "error [deg]", "all fits", "nearest set", "inputs", "independent residuals",
        "less likely by", "by start", "time [s]",
    )  # fmt: skip
    how = paragraph(
        f"Every set of the first diagnosis is fitted to {', '.join(GIVEN)} with the commanded or the measured torque",
        "of each joint, inputs held from row to row or linear between rows (one way for both joints), from two",
        f"starts: {len(first.fits)} fits of each choice. *Less likely by* is the difference in log-likelihood to the",
        "nearest choice: independent residuals times the difference of the logarithms of the errors, with a 95 %",
        "interval by a paired t test over segments. *By start* is the same difference between the fits of one set,",
        "inputs and data from the two starts.",
    )
    answer = "No choice is farther than chance: these runs do not tell which torque drives the arm."
    if farther:
        answer = (
            f"Of {len(others)} others, {', '.join(farther)} is farther than chance; the rest cannot be distinguished."
        )
    what = paragraph(
        f"The nearest choice is {' / '.join(first.torques)}. It is the best of {len(choices)} choices and of",
        f"{len(first.fits)} fits, so that small differences mean little. {answer} All other cases use",
        f"{' / '.join(MEASURED)}.",
    )
    return "\n\n".join(["### Which torque drives the arm", how, table(head, rows), what])


def _prediction(found: Answers) -> str:
    head = (
        "model", "windows: joints [deg]", "NRMSE", "whole run: joints [deg]", "NRMSE", "offsets [deg]",
        "windows with offsets [deg]", "NRMSE", "whole run with offsets [deg]", "NRMSE",
    )  # fmt: skip
    how = paragraph(
        f"{WITHHELD} is simulated open loop by three models: in windows of {WINDOW:g} s, each from the measured angles",
        "and rates at its beginning, and as a whole from its first row, torques linear between rows. Given are root",
        "mean square errors of each joint, and thesis Eq. 19. The makers' friction is their Coulomb friction alone. In",
        "this run joint 1 is commanded no torque at all, which is so in no run that was given.",
        *(f"Reading it: {note}." for note in found.notes),
    )
    offsets = paragraph(
        "The offsets of this run's sensors are unknown, as a diagnosis finds them for each recording that it is given,",
        "and the columns without offsets take them for none. The columns with offsets fit one angle for each joint to",
        "the windows of this run, for each model by itself, and are no prediction.",
    )
    rows = [[name, *_cells(one)] for name, one in found.predictions.items()]
    return "\n\n".join(["### A run that was not given", how, table(head, rows), offsets])


def _cells(one: Prediction) -> list[str]:
    offsets = ", ".join(f"{degrees(value):+.2f}" for value in one.offsets)
    plain = [*_error(one.windows), *_error(one.whole)]
    return [*plain, offsets, *_error(one.windows_with_offsets), *_error(one.whole_with_offsets)]


def _error(one: Error) -> tuple[str, str]:
    return ", ".join(f"{degrees(value):.2f}" for value in one.rms), f"{one.nrmse:.3f}"


def _missing(first: Diagnosis) -> str:
    """Describe the missing torque at each joint of the given runs."""
    both = list(enumerate(zip(*first.sigma, strict=True), 1))
    arrows = [f"{before:.3f} -> {after:.3f} N m at joint {joint}" for joint, (before, after) in both]
    risen = [str(joint) for joint, (before, after) in both if after >= before]
    drive = np.concatenate([run.torques.values for run in first.recordings if run.torques is not None])
    usual = " and ".join(f"{value:.3f}" for value in np.sqrt(np.mean(drive**2, axis=0)))
    return paragraph(
        "What remains in the given runs, as the standard deviation of the missing torque of the refitted and of the",
        f"extended model: {', '.join(arrows)}. The root mean square of the measured torques is {usual} N m.",
        f"At joint {', '.join(risen)} nothing is gained by this measure." if risen else "",
    )
