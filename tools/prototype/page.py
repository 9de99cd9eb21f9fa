"""The page of the prototype: text around figures that were computed just now; every kind of verdict has its own."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.dataset import halves
from continuum.recordings.recording import Recording
from tools.markdown import paragraph
from tools.prototype.account import Account, Alone, Floor, Simulated
from tools.reproduction.release import TABLE_4_POSITION, TABLE_4_VELOCITY

THE_GUESS = "inertia"


def page(told: Account) -> str:
    """The whole page."""
    run, verdict = told.recording, told.verdict
    best = min(told.refitted, key=lambda one: one.position)
    return f"""# The prototype: what the diagnosis says of the real arm

Made by `make prototype`, which writes every figure here, from `data/rep7/rep7_measured.csv`: one release of the LAMECC
prototype, {run.times.size} samples of {run.n_joints} joint angles in {run.times[-1] - run.times[0]:.1f} s, read off the
author's animation. `continuum diagnose data/rep7/rep7_measured.csv` gives the same verdict.

## The verdict

{_verdict(told)}

## What the thesis's parameters leave, and what refitting them gives

Eq. 19 of free simulations of the whole run (error by the measured standard deviation, mean over the joints):

| simulation | position | rate |
|---|---|---|
| thesis, Table 4, row 7 | {TABLE_4_POSITION:.3f} | {TABLE_4_VELOCITY:.3f} |
{_rows([told.published, *told.thesis, *told.refitted, *([told.extended] if told.extended else [])])}
| sensor noise alone | {told.floor:.3f} | |

{_refitting(told, best)}

All of these were fitted to the run that they are compared with. Predicted by the other part of the run:

| part | position, refitted | position, extended | rate, refitted | rate, extended |
|---|---|---|---|---|
{_held_out(verdict)}

{_gained(verdict)}

{_spread(run)}

![Joint angles of repetition 7](pictures/prototype.png)

## Every effect alone

Each effect of the library that can act without tension (`remounted_base` is `base_tilt` in a single run), added to the
refitted model by itself, where it belongs to joints at those where it explains most, as the search does it: begun from
the refitted model, from windows as measured and from a close look, the best of which counts. The gain is that of
log-likelihood on stretches of the run that were held out; *more than chance* is the rule by which an effect may be
named (`discovery/evidence.py`).
Without any effect noise leaves {_percent(verdict["unexplained"]["before"])} of the windows unexplained.

| effect | unknowns | gain | its deviation | more than chance | left unexplained | position, free run |
|---|---|---|---|---|---|---|
{_alone(told.alone)}

## The thesis's guess

The thesis suspected that its masses and moments of inertia were wrong (`{THE_GUESS}`).
{_guess(told)}

## Reservations

- It is one repetition: whatever belongs to this run alone (a sensor's offset, a slack cable) looks like the arm's own.
{_told_little(verdict)}- The angles were read off an animation, without rates and tensions. What
  the reading errs by is in `data/rep7/README.md`; it is little beside what is unexplained. Smoothing by the author, if
  any, is unknown.
- The arm already moves in the first sample, so its first state is fitted, not known.
- The library holds what somebody thought of. What it lacks may look like what it has.

## That nothing was tuned to this run

The thresholds of the verdict were set by arms that `test/blind/plant` simulates, the usual sizes of effects come from
the sources that their files name, and the spread of parts within a batch (`identification/baseline.py`) from what such
parts keep. A test (`tools/prototype/test`) makes sure that no other code of this workspace reads the measured file but
the reproduction of the thesis, which chose the two values that the thesis does not print by the author's *simulation*.
There is one exception: that no joint angle is believed to be better than 0.1 degrees (`identification/noise.py`) was
chosen after a look at this file, whose plotted angles show next to no noise; the estimate here is
{_range(told.white)} degrees. With other limits the whole diagnosis answers (`--angle-floor`):

| angles are believed to be no better than | verdict | named, or helps |
|---|---|---|
{_floors(told.floors)}
"""


def _verdict(told: Account) -> str:
    verdict = told.verdict
    causes, named = verdict["causes"], [*verdict["causes"], *verdict["alternatives"]]
    helps = verdict["helps"]
    match verdict["verdict"]:
        case "adequate":
            more = "So the errors that the thesis was left with were those of its parameters, as far as this run shows."
        case "cause":
            more = "Stated confidence: " + ", ".join(f"{_name(c)} {c['confidence']:.2f}" for c in causes) + "."
        case "ambiguous":
            each = (f"{_name(c)} ({c['confidence']:.2f})" for c in named)
            more = "Nothing in this run decides between " + ", ".join(each) + "."
        case "unknown" if helps:
            more = "So no cause is named. What helps though it does not suffice: " + _and(map(_in_words, helps))
        case _:
            more = "So no cause is named, and nothing in the library is known to help."
    return paragraph(f"**`{verdict['verdict']}`.**", told.words) + "\n\n" + paragraph(more)


def _refitting(told: Account, best: Simulated) -> str:
    started = min(one.position for one in told.thesis)
    each = ", ".join(f"{one.position:.2f}" for one in told.thesis)
    begun = (
        f"By Eq. 19's rule the author's own simulation is {told.published.position:.2f} from the measurement in "
        f"position, our solutions with his parameters {each}, in the order of the table: what is left hangs on how the "
        "run is begun, since the arm already moves in the first sample."
    )
    if best.position >= started:
        return paragraph(begun, f"Refitting his five parameters does not lower it: {best.position:.2f} at best.")
    return paragraph(
        begun,
        f"Refitting his five parameters alone brings the least of these to {best.position:.2f}:",
        f"{_percent(1 - best.position / started)} less, and {best.position / told.floor:.0f} times what noise alone",
        "would leave.",
    )


def _gained(verdict: Mapping[str, Any]) -> str:
    added = [*verdict["causes"], *verdict["helps"]]
    if not added:
        return "There is no extended model, so that both are the same."
    before, after = verdict["unexplained"]["before"], verdict["unexplained"]["after"]
    closed = verdict["gap_closed"]
    change = f"closes {_percent(closed)} of" if closed >= 0 else f"adds {_percent(-closed)} to"
    return paragraph(
        f"The extended model ({_and(_name(one) for one in added)}) {change} the distance to the noise",
        f"floor there, and lowers what noise does not explain from {_percent(before)} of the windows to",
        f"{_percent(after)}.",
    )


def _spread(run: Recording) -> str:
    """Eq. 19 divides by the standard deviation, which is not the same in both parts."""
    split = halves([run])
    beginning, end = (_deviation(part) for part in (split.identification, split.validation))
    return paragraph(
        f"The measured angles have a standard deviation of {beginning:.2f} degrees in the beginning and",
        f"{end:.2f} in the end (mean over the joints). Eq. 19 divides by it: the same error in degrees counts",
        f"{beginning / end:.1f} times as much in the end." if beginning > end else "no more in the end.",
    )


def _deviation(part: Sequence[Recording]) -> float:
    return float(np.degrees(np.std(part[0].theta, axis=0).mean()))


def _guess(told: Account) -> str:
    order = [one.effect.partition("@")[0] for one in told.alone]
    if THE_GUESS not in order:
        return "It was not tried."
    place = order.index(THE_GUESS)
    guess, best = told.alone[place], told.alone[0]
    chance = "more than chance" if guess.is_significant else "no more than chance"
    most = f"The most is gained by `{best.effect}`: {best.gain:.0f} by {_unknowns(best)}." if place else ""
    return paragraph(
        f"Alone it gains {guess.gain:.0f} (deviation {guess.deviation:.0f}), {chance}, by {_unknowns(guess)},",
        f"and leaves {_percent(guess.unexplained)} of the windows unexplained: place {place + 1} of {len(order)}.",
        most,
        _of_the_guess(told.verdict, guess.is_significant),
        "Of a release without tension, masses, springs and frictions all larger by one factor cannot be told at all.",
    )


def _unknowns(one: Alone) -> str:
    return f"{one.unknowns} unknown{'s' * (one.unknowns != 1)}"


def _of_the_guess(verdict: Mapping[str, Any], some: bool) -> str:
    """What the verdict says of it, and whether alone it explains more than chance."""
    causes, alternatives, helps = (
        [cause["effect"] for cause in verdict[key]] for key in ("causes", "alternatives", "helps")
    )
    kind = verdict["verdict"]
    if THE_GUESS in causes and kind == "cause":
        return "The verdict names it: this run speaks for the thesis's guess."
    if THE_GUESS in (*causes, *alternatives) and kind == "ambiguous":
        return "The verdict holds it possible beside others: this run neither confirms nor refutes the guess."
    if THE_GUESS in helps:
        return "It is part of what helps, but does not suffice: this run does not confirm the guess."
    if some:
        return (
            "The verdict does not name it: alone it explains something, others more by fewer unknowns, and none "
            "enough. This run neither confirms nor refutes the guess."
        )
    return "The verdict does not name it: this run does not speak for the guess."


def _rows(simulated: Iterable[Simulated]) -> str:
    return "\n".join(f"| {one.name} | {_figure(one.position)} | {_figure(one.rate)} |" for one in simulated)


def _held_out(verdict: Mapping[str, Any]) -> str:
    lines = []
    for name, position in verdict["nrmse_position"].items():
        rate = verdict["nrmse_velocity"][name]
        cells = (_figure(scores[when]) for scores in (position, rate) for when in ("before", "after"))
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def _floors(floors: Sequence[Floor]) -> str:
    return "\n".join(f"| {f.degrees:g} degrees | `{f.verdict}` | {', '.join(f.effects) or 'nothing'} |" for f in floors)


def _alone(effects: Sequence[Alone]) -> str:
    return "\n".join(
        f"| `{one.effect}` | {one.unknowns} | {_figure(one.gain, 0)} | {_figure(one.deviation, 0)}"
        f" | {'yes' if one.is_significant else 'no'} | {_percent(one.unexplained)} | {_figure(one.position)} |"
        for one in effects
    )


def _told_little(verdict: Mapping[str, Any]) -> str:
    return f"- {verdict['weakness'][0].upper()}{verdict['weakness'][1:]}.\n" if verdict["weakness"] else ""


def _in_words(cause: Mapping[str, Any]) -> str:
    return f'{_name(cause)} ("{effect_named(cause["effect"]).in_words}")'


def _name(cause: Mapping[str, Any]) -> str:
    joints = cause["joints"]
    if joints is None:
        return f"`{cause['effect']}`"
    return f"`{cause['effect']}` at joint{'s' if len(joints) > 1 else ''} {_and(map(str, joints))}"


def _and(words: Iterable[str]) -> str:
    *most, last = words
    return f"{', '.join(most)} and {last}" if most else last


def _figure(value: float | None, digits: int = 3) -> str:
    return "cannot be simulated" if value is None or not math.isfinite(value) else f"{value:.{digits}f}"


def _percent(part: float) -> str:
    return f"{100 * part:.0f} %"


def _range(values: np.ndarray) -> str:
    low, high = f"{values.min():.2f}", f"{values.max():.2f}"
    return low if low == high else f"{low} to {high}"
