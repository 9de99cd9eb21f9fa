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
from tools.markdown import paragraph, table
from tools.prototype.account import FITTED, THE_GUESS, Account
from tools.prototype.stability import READING, RELATIVE, Said
from tools.reproduction.release import TABLE_4_POSITION


def page(account: Account) -> str:
    """The whole page."""
    result, (run,) = account.diagnosis, account.diagnosis.recordings
    text = f"""# The prototype: what the diagnosis says of the real arm

Made by `make prototype`, which writes every figure here, from `data/rep7/rep7_measured.csv`: one release of the LAMECC
prototype, {run.times.size} samples of {run.n_joints} joint angles in {run.times[-1] - run.times[0]:.1f} s, without
tensions, read off the author's animation. `continuum diagnose data/rep7/rep7_measured.csv` gives the same verdict.

## What is known

{_known(account)}

## The verdict

**`{result.verdict.kind.value}`.** {verdict_in_words(result)}

{"".join(f"- {line}\n" for line in (*result.notes, *similar_causes(result), *_probabilities(result)))}
{table(("value", "estimate, 95 % interval"), _estimates(result))}

Share of the open-loop error that each effect closes, and what stays unknown:

{table(("", "share, 95 % interval"), shares_in_words(result))}

Intervals of shares come from the spread over the segments of half a second that are simulated.

Standard deviation of the missing torque, refitted{" -> extended" * result.is_extended} model:

{table(("", "missing torque"), sigma_in_words(result))}

## Open-loop simulations of the whole run

Eq. 19 of the joint angles (error by the measured standard deviation, mean over the joints). Refitted and extended
model were fitted to the run that they are compared with here. The noise of an angle is estimated to be
{np.degrees(result.before.floor):.4f} degrees; the plot was read with 0.01 to 0.3 (`data/rep7/README.md`).

{table(("simulation", "Eq. 19", "error [deg]"), _simulations(account))}

![Joint angles of repetition 7](pictures/prototype.png)

## The end of the run, predicted

{_end(account)}

## The same again

Changed by {RELATIVE:g} of themselves, or with other kernels of linear algebra, the angles must say the same:
{_sameness(account.rounding)}. White noise of {READING:g} degrees is about what the plot was read with:
{_sameness(account.noise)}.

{table(("changed", "kernel", "verdict", "effects", "closed share"), map(_row, (*account.rounding, *account.noise[1:])))}

## Every effect alone, and the thesis's guess

{_alone(account)}

## What one recording cannot tell

- Whatever belongs to this run alone (a sensor's offset, a slack cable) looks like the arm's own.
- No other motion tests the answer; the end of this one, nearly at rest, hardly does.
- Of a release without tension, masses, springs and frictions all larger by one factor cannot be told at all.
- The arm already moves in the first sample, so its first state is estimated, not known.
- Whether the author smoothed the angles is unknown.
- The library holds what somebody thought of. What it lacks may look like what it has.

A test (`tools/prototype/test`) makes sure that no other code of this workspace reads the measured file but the
reproduction of the thesis."""
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
    return f"""The thesis integrates the gyros' rates from an instant at which the angles were not known, so that every
joint's angle has an unknown zero. A zero of the sensors ({labels}) accounts for {100 * helped:.0f} % of what the
refitted simulation gets wrong about this release. That is the largest share of any single effect, but it leaves a
remainder, and its value moves with how the data are taken (below): it is not a proven cause.

Standard deviation of the missing torque, refitted and with that zero, and the part of its square that is gone:

{table(("", "refitted [mN m]", "with the zero [mN m]", "gone"), joints)}

What would tell: a protractor at each joint before the release, or the arm hanging at rest in the first and the last
second of the recording, gives the zeros. {f"By simulation of the fitted models: {shown}" if shown else ""}"""


def _probabilities(result: Diagnosis) -> list[str]:
    sets = zip(result.sets, result.verdict.probabilities, strict=False)
    each = [f"{' + '.join(cause.label for cause in causes) or 'nothing'} {p:.2f}" for causes, p in sets]
    return [f"probabilities among these: {', '.join(each)}"] if len(each) > 1 else []


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
which no fit has seen, from where the beginning ends: *smoothed* from the beginning alone, or *measured* at the cut
(angles of the next row less what the sensors add, rates by a cubic through seven rows).

{table(head, [*rows, sd])}

Eq. 19 divides by the measured standard deviation, the last row. Joints that rest, joint {quiet + 1} with
{account.sd[quiet]:.3f} degrees, nearly alone decide it; *where joints move* leaves out those with less than half a
degree.

The engine before this one (this page of 24 November 2026) cut the run at the same row. Its models, fitted to the
beginning, had an Eq. 19 of 9.72 (refitted) and 5.14 (extended by `angle_offset` at joint 3) in the end. The 0.73 and
0.33 beside these were of the beginning, by models fitted to the end. They began as the first window of the end
suggested, and the offset was fitted to the end itself, which is not done here; *measured* comes nearest to that."""


def _sameness(again: Sequence[tuple[str, Said]]) -> str:
    first, answers = again[0][1], [one for _, one in again]
    kinds = sum(one.kind == first.kind for one in answers)
    same = sum((one.kind, one.effects) == (first.kind, first.effects) for one in answers)
    low, high = (_percent(pick(one.closed for one in answers)) for pick in (min, max))
    return (
        f"of {len(answers)} answers, that of the file as it is among them, {kinds} have its verdict, {same} its effects"
        f" and joints too, and they close {low} to {high}"
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
    with_guess = f"Beside what the verdict adds, `{where}` promises {_lowered(gain)}."
    return f"""By how much each effect is expected to lower the refitted model's open-loop error by itself, at joints
where that is most: by open-loop sensitivities, one step from the fit. Effects with states and those that need tension
are left out.

{table(("effect", "error"), rows)}

The thesis suspected that its masses and moments of inertia were wrong (`{THE_GUESS}`). Alone, `{label}` promises
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
