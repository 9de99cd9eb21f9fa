"""The page of the prototype: text around figures that were computed just now, whatever they are."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from continuum.arrays import Array
from continuum.discovery import Diagnosis
from continuum.discovery.power_words import experiment_in_words
from continuum.discovery.result import is_named
from continuum.discovery.words import (
    estimate_in_words,
    shares_in_words,
    sigma_in_words,
    similar_causes,
    verdict_in_words,
)
from continuum.identification.nrmse import nrmse
from tools.benchmarks.prototype.account import FITTED, THE_GUESS, Account
from tools.benchmarks.prototype.stability import READING, RELATIVE, Said
from tools.benchmarks.reproduction.release import TABLE_4_POSITION
from tools.docs.markdown import paragraph, table


def page(account: Account) -> str:
    """The whole page."""
    result, (run,) = account.diagnosis, account.diagnosis.recordings
    text = f"""# The prototype: what the diagnosis says of the real arm

`make prototype` writes every figure here from `data/rep7/rep7_measured.csv`. The file holds one release of the LAMECC
prototype, {run.times.size} samples of {run.n_joints} joint angles in {run.times[-1] - run.times[0]:.1f} s, without
tensions, read off the author's animation. `continuum diagnose data/rep7/rep7_measured.csv` gives the same verdict.

## What is known

{_known(account)}

## The verdict

**`{result.verdict.kind.value}`.** {verdict_in_words(result)}

{"".join(f"- {line}\n" for line in (*result.notes, *similar_causes(result), *_relative_fits(result)))}
{table(("value", "estimate, 95 % interval"), _estimates(result))}

Share of the open-loop error that each effect closes, and the unknown remainder:

{table(("", "share, 95 % interval"), shares_in_words(result))}

The intervals of the shares follow from their scatter over the simulated half-second segments.

Standard deviation of the missing torque, refitted{" -> extended" * result.is_extended} model:

{table(("", "missing torque"), sigma_in_words(result))}

## Open-loop simulations of the whole run

The table gives Eq. 19 of the joint angles (error divided by the standard deviation of the measurement, mean over the
joints). Refitted and extended model were fitted to the run that they are compared with here. The estimated noise of an
angle is {np.degrees(result.before.floor):.4f} degrees; the plot was read with an error of 0.01 to 0.3
(`data/rep7/README.md`).

{table(("simulation", "Eq. 19", "error [deg]"), _simulations(account))}

![Joint angles of repetition 7](pictures/prototype.png)

## The end of the run, predicted

{_end(account)}

## The same again

The answer must not change if the angles change by {RELATIVE:g} of themselves, or with other kernels of linear
algebra: {_sameness(account.rounding)}. White noise of {READING:g} degrees is about the reading error of the plot:
{_sameness(account.noise)}.

{table(("changed", "kernel", "verdict", "effects", "closed share"), map(_row, (*account.rounding, *account.noise[1:])))}

## Every effect alone, and the thesis's guess

{_alone(account)}

## What one recording cannot tell

- Anything that belongs to this run alone (an offset of a sensor, a slack cable) looks like a property of the arm.
- No other motion tests the answer, and the end of this one, nearly at rest, hardly does.
- A release without tension cannot show whether masses, springs and frictions are all larger by one factor.
- The arm already moves in the first sample, so its first state is estimated, not known.
- It is unknown whether the author smoothed the angles.
- The library contains only effects that somebody thought of. An effect that it lacks may look like one that it has.

A test (`tools/benchmarks/prototype/test`) ensures that apart from this page, only the reproduction of the thesis reads
the measured file."""
    as_they_are = ("|", "#", "-", "!")
    parts = [part.strip() for part in text.split("\n\n")]
    return (
        "\n\n".join(part if part.startswith(as_they_are) else paragraph(*part.split()) for part in parts if part) + "\n"
    )


def _known(account: Account) -> str:
    """Zeros of sensors, what stays at each joint, and the run that would tell it."""
    result, before, after = account.diagnosis, *(1e3 * sigma for sigma in account.diagnosis.sigma)
    zeros = [cause for cause in result.causes if cause.effect == "angle_offset"]
    helped = sum(cause.share.value for cause in zeros)
    gone = 1 - after**2 / before**2
    joints = [(f"joint {j + 1}", f"{b:.1f}", f"{a:.1f}", f"{100 * g:.0f} %")
              for j, (b, a, g) in enumerate(zip(before, after, gone, strict=True))]  # fmt: skip
    labels = ", ".join(f"`{cause.label}`" for cause in zeros) or "none"
    shown = experiment_in_words(result)
    return f"""The thesis integrates the gyroscopes' rates from an instant at which the angles were not known, so
every joint angle has an unknown zero. A sensor zero ({labels}) accounts for {100 * helped:.0f} % of the error of the
refitted simulation for this release. That is the largest share of any single effect. But a remainder is left, and the
value depends on small changes of the data (below): it is not a proven cause.

Standard deviation of the missing torque, refitted and with that zero, and the part of its variance that is removed:

{table(("", "refitted [mN m]", "with the zero [mN m]", "removed"), joints)}

A protractor at each joint before the release would give the zeros. So would a recording whose first and last second
show the arm hanging at rest. {f"Simulations of the fitted models propose: {shown}" if shown else ""}"""


def _relative_fits(result: Diagnosis) -> list[str]:
    sets = zip(result.sets, result.verdict.relative_fits, strict=False)
    each = [f"{' + '.join(cause.label for cause in causes) or 'nothing'} {p:.2f}" for causes, p in sets]
    return [f"relative fit of these: {', '.join(each)}"] if len(each) > 1 else []


def _estimates(result: Diagnosis) -> list[tuple[str, str]]:
    own = [one for causes in result.sets for cause in causes for one in cause.estimates]
    return [(f"`{one}`", estimate_in_words(one)) for one in (*own, *result.estimates)]


def _simulations(account: Account) -> list[tuple[str, str, str]]:
    result, (run,) = account.diagnosis, account.diagnosis.recordings

    def row(name: str, theta: Array) -> tuple[str, str, str]:
        rms = np.degrees(np.sqrt(np.mean((theta - run.theta) ** 2)))
        return name, f"{nrmse(theta, run.theta):.3f}", f"{rms:.2f}"

    rows = [
        ("thesis, Table 4, row 7", f"{TABLE_4_POSITION:.3f}", ""),
        row("thesis's parameters, at rest in the first measured angles", account.thesis),
        row("refitted, from the smoothed beginning", result.before.angles[0]),
    ]
    return [*rows, row("extended, from the smoothed beginning", result.after.angles[0])] if result.is_extended else rows


def _end(account: Account) -> str:
    joints, quiet, moving = range(1, account.sd.size + 1), int(np.argmin(account.sd)), account.sd > 0.5
    labels = ", ".join(f"`{cause.label}`" for cause in account.of_beginning.causes) or "nothing"
    rows = [
        (one.model, one.begins, f"{np.mean(one.by_joint):.2f}", f"{np.mean(one.by_joint[moving]):.2f}",
         *(f"{x:.2f}" for x in (np.sqrt(np.mean(one.degrees**2)), *one.degrees)))
        for one in account.predicted
    ]  # fmt: skip
    sd = ("measured", "", "", "", "", *(f"{x:.2f}" for x in account.sd))
    head = ("model", "begins", "Eq. 19", "where joints move", "error [deg]", *(f"joint {j} [deg]" for j in joints))
    return f"""The first {100 * FITTED:.0f} % of the rows were diagnosed:
`{account.of_beginning.verdict.kind.value}`, with {labels} in the extended model. Both models then simulate the rest,
which no fit has seen, from the state at the cut. This state is either *smoothed* from the beginning alone, or
*measured* (angles of the next row less the sensor errors of the model, rates by a cubic through seven rows).

{table(head, [*rows, sd])}

Eq. 19 divides by the measured standard deviation, the last row. The joints at rest, mainly joint {quiet + 1} with
{account.sd[quiet]:.3f} degrees, dominate it; *where joints move* leaves out those with less than half a degree.

The previous version of the diagnosis (this page of 24 November 2026) cut the run at the same row. Its models, fitted
to the beginning, had an Eq. 19 of 9.72 (refitted) and 5.14 (extended by `angle_offset` at joint 3) at the end. The page
also gave 0.73 and 0.33, for the beginning by models fitted to the end. Its simulations started from the state that the
first window of the end suggested, and the offset was fitted to the end itself. This page does not do that; *measured*
comes closest to it."""


def _sameness(again: Sequence[tuple[str, Said]]) -> str:
    first, answers = again[0][1], [one for _, one in again]
    kinds = sum(one.kind == first.kind for one in answers)
    same = sum((one.kind, one.effects) == (first.kind, first.effects) for one in answers)
    low, high = (_percent(pick(one.closed for one in answers)) for pick in (min, max))
    return (
        f"of {len(answers)} answers, including that of the unchanged file, {kinds} have its verdict, {same} also its"
        f" effects and joints, and they close {low} to {high}"
    )


def _row(again: tuple[str, Said]) -> tuple[str, str, str, str, str]:
    what, one = again
    effects = " or ".join(f"`{effect}`" for effect in one.effects) or "none"
    return what, one.kernel, f"`{one.kind}`", effects, _percent(one.closed)


def _alone(account: Account) -> str:
    names = [label.partition("@")[0] for label, _ in account.alone]
    place, (where, gain) = names.index(THE_GUESS), account.with_guess
    label, own = account.alone[place]
    rows = [(f"`{name}`", _lowered(gain)) for name, gain in account.alone]
    with_guess = f"Added to what the verdict adds, `{where}` predicts {_lowered(gain)}."
    return f"""The table gives the change of the refitted model's open-loop error that each effect
alone predicts, at the joints where it predicts most. The prediction is one step from the fit by open-loop
sensitivities. Effects with states and those that need tension are left out.

{table(("effect", "error"), rows)}

The thesis suspected that its masses and moments of inertia were wrong (`{THE_GUESS}`). Alone, `{label}` predicts
{_lowered(own)}, place {place + 1} of {len(names)}. {with_guess * bool(where)} {_said_of_guess(account.diagnosis)}"""


def _lowered(gain: float) -> str:
    return f"{100 * np.expm1(-gain):.0f} %"


def _said_of_guess(result: Diagnosis) -> str:
    sets = [{cause.effect for cause in causes} for causes in result.sets]
    if not any(THE_GUESS in one for one in sets):
        return "The verdict does not name it: this run neither confirms nor refutes the guess."
    if not is_named(result.verdict.kind):
        return "It is part of what helps, but no cause is named: this run does not confirm the guess."
    return "The verdict names it" + (": this run speaks for the guess." if len(sets) == 1 else ", among others.")


def _percent(part: float) -> str:
    return f"{100 * part:.0f} %"
