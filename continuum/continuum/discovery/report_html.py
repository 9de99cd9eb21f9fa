"""Findings as one self-contained page."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path

import numpy as np

from continuum.discovery.diagnose import Diagnosis
from continuum.discovery.evidence import gain, unexplained
from continuum.discovery.findings import Estimate, Findings
from continuum.discovery.in_words import (
    RATE_IN_WORDS,
    cost_in_words,
    identifiability_in_words,
    in_full,
    other_in_words,
    scores_in_words,
    verdict_in_words,
    worth_in_words,
)
from continuum.discovery.motion_phases import PHASES, errors_by_phase
from continuum.discovery.pictures import evidence_picture, runs_picture, torque_picture
from continuum.discovery.residual_torque import ResidualTorque
from continuum.discovery.round import Round
from continuum.discovery.structure_tests import StructureTest
from continuum.discovery.verdict import Cause, Kind, Verdict
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import Parameter
from continuum.whole_file import write_whole

_HEAD = (
    '<!doctype html><html lang="en"><meta charset="utf-8">'
    '<meta name="viewport" content="width=device-width, initial-scale=1">'
)
_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; color: #222; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.1rem; margin-top: 2.2rem; border-bottom: 1px solid #ddd; }
.verdict { font-size: 1.1rem; background: #f2f6fa; border-left: 5px solid #1f6fb4; padding: .8rem 1rem; }
.unknown, .ambiguous { border-color: #d1802b; background: #fbf5ec; }
table { border-collapse: collapse; font-size: .85rem; display: block; overflow-x: auto; }
td, th { padding: .2rem .9rem .2rem 0; text-align: right; }
td:first-child, th:first-child, .words td:last-child, .words th:last-child { text-align: left; }
th { border-bottom: 1px solid #bbb; font-weight: 600; }
img { max-width: 100%; } .note { color: #666; font-size: .85rem; }
"""
_CHANCE, _SHOWN = 0.05, 8
"""p-value up to which a comparison is a hint, and how many are shown at most."""

_FREE = (
    "Free simulation from the state that the first tenth of a second asks for (what a recording has for itself, as a "
    "sensor's offset, is what all of it asks for), by models that were fitted to"
)
_PHASES = (
    "The same errors by joint and by what the joint is doing, root mean square over all runs [degrees]. A joint is at "
    "rest below 6 degrees/s, unless it turns back within a tenth of a second. Runs count that both models can simulate."
)
_MISSING = (
    "Torque that a model would need beside its own to follow the measurements, by angle and by rate. What it goes with "
    "is a hint to its kind (the less p the surer; above 0.05 it is none); the verdict rests on the effects tried below."
)
_GAINS = (
    "Gain: log-likelihood on runs that were held out, and its standard deviation; information: what the fit to all "
    "runs gains, less the price of its unknowns (BIC)."
)


def write_report(
    path: str | Path,
    diagnosis: Diagnosis,
    found: Findings,
    torques: tuple[Sequence[ResidualTorque], Sequence[ResidualTorque] | None],
    tests: Sequence[StructureTest],
    made: str,
) -> None:
    """Write the page.

    Args:
        path: where.
        diagnosis, found: what to tell.
        torques: missing torque of the refitted and of the extended model; None where there is none.
        tests: of the former.
        made: how the page was made, one line.

    Raises:
        FileError: the file cannot be written.
    """
    kind = found.verdict.kind.value
    extended = bool(found.verdict.extension)
    body = [
        f"<h1>What the simulation gets wrong: {escape(_wrong(found.verdict))}</h1>",
        f'<p class="verdict {kind}">{escape(verdict_in_words(found.verdict))}</p>',
        *_candidates(found.verdict),
        *([f'<p class="note">Mind: {escape(found.weakness)}.</p>'] if found.weakness else []),
        *(f'<p class="note">{escape(note)}</p>' for note in found.notes),
        "<h2>Measured and simulated</h2>",
        f'<p class="note">{_FREE} {_others(diagnosis)}.</p>',
        _image("joint angles, measured and simulated", runs_picture(found.before, found.after, extended)),
        _scores(found, extended),
        '<p class="note">Eq. 19 of the thesis: root mean square error by standard deviation, mean over the joints, '
        "with 95 % intervals from stretches of the run. A joint that hardly moves counts as others do."
        + (f" {_worth(found)}" if extended else "")
        + "</p>",
        f'<p class="note">{_PHASES}</p>',
        _phases(found, extended),
        "<h2>What is missing</h2>",
        f'<p class="note">{_MISSING}</p>',
        _image("missing torque by angle and by rate", torque_picture(*torques)),
        *_hints(tests),
        *(part for number, one in enumerate(diagnosis.rounds, 1) for part in _evidence(number, one)),
        "<h2>Parameters</h2>",
        _estimates(found.estimates, found.model.meanings()),
        _run_numbers(diagnosis, found),
        *(part for one in zip(found.verdict.alternatives, found.others, strict=True) for part in _instead(*one)),
        *(f'<p class="note">{escape(line)}</p>' for line in identifiability_in_words(found.identifiability)),
        f'<p class="note">{escape(made)}</p>',
    ]
    runs = ", ".join(recording.name for recording in diagnosis.question.recordings)
    head = f"{_HEAD}<title>{escape(kind)}: {escape(runs)}</title><style>{_STYLE}</style>"
    write_whole(path, head + "\n".join(body) + "</html>\n")


def _wrong(verdict: Verdict) -> str:
    """The verdict as a title says it."""
    match verdict.kind:
        case Kind.ADEQUATE:
            return "nothing that these data show"
        case Kind.UNKNOWN:
            return "something, and what is unknown"
    named = dict.fromkeys(str(cause.addition) for cause in (*verdict.causes, *verdict.alternatives))
    return (" or " if verdict.kind is Kind.AMBIGUOUS else " and ").join(named)


def _hints(tests: Sequence[StructureTest]) -> Iterable[str]:
    """The surest things that the missing torque goes with."""
    surest = [test for test in tests if test.p_value <= _CHANCE][:_SHOWN]
    if surest:
        yield _table(
            ("missing torque at", "goes with", "correlation", "p"),
            [(f"joint {t.joint + 1}", t.against, f"{t.correlation:+.2f}", f"{t.p_value:.3f}") for t in surest],
        )
    if not tests:
        yield '<p class="note">These data tell it too seldom to compare it with anything.</p>'
        return
    told = "The surest" if surest else "It goes with nothing; this is the outcome"
    yield f'<p class="note">{told} of {len(tests)} comparisons, of which chance puts one in twenty below {_CHANCE}.</p>'


def _candidates(verdict: Verdict) -> Iterable[str]:
    """Table of what is named, in the order in which it is believed."""
    named = (*verdict.causes, *verdict.alternatives)
    if named and verdict.kind is not Kind.UNKNOWN:
        title = "cause" if verdict.kind is Kind.CAUSE else "may be the cause"
        yield _table((title, "confidence"), [(in_full(c), f"{c.confidence:.2f}") for c in named])


def _meanings(effect: str) -> Mapping[str, Parameter]:
    return {f"{effect}.{name}": parameter for name, parameter in effect_named(effect).parameters.items()}


def _instead(cause: Cause, own: Sequence[Estimate]) -> Iterable[str]:
    yield f'<p class="note">If it is {escape(in_full(cause))} instead:</p>'
    yield _estimates(own, _meanings(cause.addition.effect))


def _estimates(estimates: Sequence[Estimate], meanings: Mapping[str, Parameter]) -> str:
    return _table(
        ("parameter", "value", "95 % from", "to", "unit", "", "what it is"),
        [
            (
                str(e.unknown),
                *(f"{x:.4g}" for x in (e.value, e.low, e.high)),
                e.unit * (e.unit != "1") + _in_degrees(e),
                "at the limit" * e.at_limit,
                meanings[e.unknown.name].meaning,
            )
            for e in estimates
        ],
        "words",
    )


def _in_degrees(e: Estimate) -> str:
    return f" = {np.degrees(e.value):.3g} degrees" if e.unit == "rad" else ""


def _run_numbers(diagnosis: Diagnosis, found: Findings) -> str:
    """Which run is which, where parameters are told of single ones."""
    if all(one.unknown.recording is None for one in found.estimates):
        return ""
    names = [f"run {i} is {recording.name}" for i, recording in enumerate(diagnosis.question.recordings, 1)]
    return f'<p class="note">{escape("; ".join(names))}.</p>'


def _scores(found: Findings, extended: bool) -> str:
    rows: list[tuple[str, ...]] = []
    for before, after in zip(found.before, found.after, strict=True):
        models = [scores_in_words(score) for score in ((before, after) if extended else (before,))]
        rows.append((before.name, "position", *(told["position"] for told in models), f"{before.floor:.3f}"))
        rows.append(
            ("", RATE_IN_WORDS[before.recording.theta_rate is not None], *(told["rate"] for told in models), "")
        )
    return _table(("run", "", "refitted", *(["extended"] if extended else []), "noise alone"), rows)


def _phases(found: Findings, extended: bool) -> str:
    before, after = np.rad2deg(errors_by_phase(found.before, found.after))
    rows = [
        (phase, *(_changed(b, a, extended) for b, a in zip(*errors, strict=True)))
        for phase, *errors in zip(PHASES, before, after, strict=True)
    ]
    return _table(
        ("refitted -> extended" if extended else "", *(f"joint {j + 1}" for j in range(before.shape[1]))), rows
    )


def _changed(before: float, after: float, extended: bool) -> str:
    told = [f"{x:.2f}" for x in ((before, after) if extended else (before,)) if not np.isnan(x)]
    return " -> ".join(told) or "-"


def _others(diagnosis: Diagnosis) -> str:
    return "other runs" if len(diagnosis.question.recordings) > 1 else "the other part of the run"


def _worth(found: Findings) -> str:
    other = f" {other_in_words(found.other.addition, found.other.closed)}." if found.other else ""
    return f"{worth_in_words(found.closed)}; {cost_in_words(found.before, found.after)}.{other}"


def _evidence(number: int, one: Round) -> Iterable[str]:
    yield f"<h2>Effects tried, round {number}</h2>"
    yield _image("gain of each effect on held-out runs", evidence_picture(one))
    rows = []
    for trial in one.leaders:
        won = gain(trial, one.before)
        gains = [f"{x:.0f}" for x in (won.log_likelihood, won.deviation, won.information)]
        rows.append((str(trial.extension[-1]), *gains, _share(unexplained(trial))))
    yield _table(("effect", "gain", "deviation", "information", "data left unexplained"), rows)
    led = {trial.extension[-1].effect for trial in one.leaders}
    others = ", ".join(str(look.extension[-1]) for look in one.looks if look.extension[-1].effect not in led)
    yield f'<p class="note">{_GAINS} Set aside after a first look: {escape(others)}.</p>'


def _share(share: float) -> str:
    return f"{100 * share:.1f} %"


def _image(shown: str, png: bytes) -> str:
    return f'<img alt="{escape(shown)}" src="data:image/png;base64,{base64.b64encode(png).decode()}">'


def _table(head: Sequence[str], rows: Iterable[Sequence[str]], kind: str = "numbers") -> str:
    cells = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    lines = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f'<table class="{kind}"><tr>{cells}</tr>{lines}</table>'
