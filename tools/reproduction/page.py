"""The page of the reproduction: its text, around figures that were computed just now."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from continuum.arrays import Array
from continuum.curvature.comparison import Comparison, Distance
from continuum.curvature.median_error import SLOW
from continuum.curvature.sentences import nearer_in_words
from tools.markdown import paragraph
from tools.reproduction.curvature import TOTAL_BEND, Curvature
from tools.reproduction.release import TABLE_4_POSITION, TABLE_4_VELOCITY, Release, over_all, prototype


def page(release: Release, otherwise: Mapping[tuple[str, float], Release], curvature: Curvature) -> str:
    """The whole page.

    Args:
        release: of repetition 7.
        otherwise: the same with another value, by the parameter and the value.
        curvature: of the thesis's chapter 4.3.
    """
    rest, thrown = release.distance(release.from_rest), release.distance(release.thrown)
    n = rest.size
    signals = {
        "the author's simulation": release.published.theta,
        "ours, from rest": release.from_rest.theta,
        "ours, initial rates free": release.thrown.theta,
    }
    nrmse = "\n".join(
        f"| {name} | {release.velocity_nrmse(theta):.3f} | {release.position_nrmse(theta):.3f} |"
        for name, theta in signals.items()
    )
    p = prototype().parameters
    pulled, returning = curvature.pulled, curvature.returning
    zone, even = pulled.zone, np.full(n, TOTAL_BEND / n)
    moved = np.degrees(np.abs(np.diff(release.measured.theta[:2], axis=0))[0])
    joints = _cells(f"joint {i}" for i in range(1, n + 1))
    rates = ", ".join(f"{x:.0f}" for x in np.degrees(release.thrown.theta_rate[0]))
    his = release.velocity_nrmse(release.published.theta)
    return f"""# The thesis's dynamic model, reproduced

Made by `make reproduction`, which writes every figure here. Model: `lamecc_prototype.yaml`, Tables 1 and 3, and two
values that the thesis does not print, chosen because they reproduce the author's simulation: the centre of mass of a
link at its disc, {1e3 * p.center_of_mass[0]:g} mm beyond its joint, and k_v = {p.friction_slope[0]:g} s/rad.

## Repetition 7: our Eq. 12 beside the author's

`data/rep7` holds what the author published of one release test, read off his animation: the measured joint angles, and
his own simulation of them. Ours starts from the first row of his, at the thesis's tolerances. He does not print the
initial rates; his arm already moves in the second row. So there are two runs: from rest, and with the five initial
rates free, found by least squares with the exact sensitivities of the trajectory.

| root mean square distance to his simulation [deg] | {joints} | all |
|---|{"---|" * (n + 1)}
| from rest | {_cells(f"{x:.2f}" for x in rest)} | {over_all(rest):.2f} |
| initial rates free | {_cells(f"{x:.3f}" for x in thrown)} | {over_all(thrown):.3f} |

The initial rates found: {rates} deg/s. Goals: 0.9 degrees from rest, 0.2 with the rates free. What is left then is
partly the reading of the plot (0.01 to 0.1 degrees), partly k_v. How much hangs on the two values that were chosen:

| rms over all joints [deg] | from rest | initial rates free |
|---|---|---|
{_others(release, otherwise)}

The centre of mass was found by this comparison, not predicted by it; k_v hardly matters.

![Joint angles of repetition 7](pictures/reproduction_release.png)

Against the measurement (Eq. 19: error by the measured standard deviation, mean over the joints; rates are slopes of
local cubics through seven samples, for all signals alike):

| simulation | NRMSE of velocity | NRMSE of position |
|---|---|---|
| Table 4, row 7 | {TABLE_4_VELOCITY:.3f} | {TABLE_4_POSITION:.3f} |
{nrmse}

The thesis's {TABLE_4_VELOCITY:.2f} of velocity was computed from the gyros' rates, which were not published; from the
angles his own simulation gives {his:.2f}. How it normalised positions the thesis does not say: by Eq. 19's rule his own
simulation does not give what his table prints, so that column shows only that ours and his are alike.

## Chapter 4.3: one total bend by one cable

The arm hangs, mu_c = {p.capstan_friction[0]:g}. Constant curvature bends every joint alike; the dynamic model
rests at its equilibrium with the same total bend, one cable having been pulled until then. Both are compared by the
functions of `continuum curvature` ([curvature.md](curvature.md)). At the 90 degrees of Fig. 10, for which the thesis
prints no numbers:

| joint angle [deg] | {joints} |
|---|{"---|" * n}
| constant curvature | {_cells(_degrees(even))} |
| dynamic model ({pulled.load.tension.max():.1f} N) | {_cells(_degrees(pulled.theta))} |
| smallest angle that dry friction holds | {_cells(_degrees(zone.lower))} |
| largest | {_cells(_degrees(zone.upper))} |
| dynamic model after a larger bend ({returning.load.tension.max():.1f} N) | {_cells(_degrees(returning.theta))} |

Smallest and largest angle are each joint's extremes over all postures in which no joint is pulled by more than its
break-away torque of {zone.break_away[0]:.3f} N m; they are not reached together. The cable's losses are those of the
pull. The last row is for an arm that came back from a larger bend, its cable being let out: it takes less tension, and
bends more at the tip.

The dynamic model bends less near the base, which carries the weight of all links beyond it, than near the tip, in spite
of what the cable loses on the way.

Fig. 10's measured angles were not published, but repetition 7 was released from such a posture, to the other side. Its
first rows are taken here as if the arm rested in them, the angle of a joint being measured with a standard deviation of
{np.degrees(SLOW):g} degrees.

{_row("the author's simulation", curvature.simulated.each[0], joints)}

{_row("the measurement", curvature.measured.each[0], joints)}

![Both models beside the first measured row](pictures/reproduction_bend.png)

The thesis states that the dynamic model is the closer one. For the first row of his simulation it is, for the first
measured row constant curvature is. The arm may move already in the measured row: joint {np.argmax(moved) + 1} turns by
{moved.max():.1f} degrees until the next.
"""


def _row(what: str, one: Comparison, joints: str) -> str:
    """Table and sentence of one first row."""
    rows = (
        ("in the row", one.theta, "", ""),
        ("constant curvature", one.constant, *_distances(one.angles_to_constant, one.tip_to_constant)),
        ("dynamic model", one.held.theta, *_distances(one.angles_to_dynamic, one.tip_to_dynamic)),
    )
    lines = "\n".join(f"| {name} | {_cells(_degrees(theta))} | {rms} | {tip} |" for name, theta, rms, tip in rows)
    return f"""First row of {what}, {np.degrees(one.theta.sum()):.1f} degrees in total:

| joint angle [deg] | {joints} | distance, rms [deg] | of the tip [mm] |
|---|{"---|" * (one.theta.size + 2)}
{lines}

{paragraph(nearer_in_words(one))}"""


def _distances(angles: Distance, tip: Distance) -> tuple[str, str]:
    """With their intervals of 95 %."""
    return (
        f"{np.degrees(angles.value):.2f} ({np.degrees(angles.low):.2f} to {np.degrees(angles.high):.2f})",
        f"{1e3 * tip.value:.0f} ({1e3 * tip.low:.0f} to {1e3 * tip.high:.0f})",
    )


def _others(release: Release, otherwise: Mapping[tuple[str, float], Release]) -> str:
    rows = {"as chosen": release} | {
        f"centre of mass {1e3 * value:g} mm" if name == "center_of_mass" else f"k_v = {value:g} s/rad": other
        for (name, value), other in otherwise.items()
    }
    return "\n".join(
        f"| {name} | {over_all(one.distance(one.from_rest)):.2f} | {over_all(one.distance(one.thrown)):.3f} |"
        for name, one in rows.items()
    )


def _cells(items: Iterable[str]) -> str:
    return " | ".join(items)


def _degrees(theta: Array) -> list[str]:
    return [f"{x:.1f}" for x in np.degrees(theta)]
