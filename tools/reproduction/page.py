"""The page of the reproduction: its text, around figures that were computed just now."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from continuum.arrays import Array
from tools.reproduction.bend import CAPSTAN_FRICTION, Bend, joint_positions
from tools.reproduction.release import TABLE_4_POSITION, TABLE_4_VELOCITY, Release, over_all


def page(release: Release, otherwise: Mapping[tuple[str, float], Release], bend: Bend, as_released: Bend) -> str:
    """The whole page.

    Args:
        release: of repetition 7.
        otherwise: the same with another value, by the parameter and the value.
        bend: of the thesis's chapter 4.3.
        as_released: the same to the total bend from which repetition 7 was released.
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
    released = np.degrees(np.abs(release.published.theta[0]))
    inside = np.abs(release.published.theta[0])
    outside = np.flatnonzero((inside < as_released.zone.lower) | (inside > as_released.zone.upper)) + 1
    p = bend.model.parameters
    b = float(p.half_spacing[0])
    even_tip, pulled_tip = (1e3 * joint_positions(theta, b)[-1] for theta in (bend.even, bend.pulled))
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

## Chapter 4.3: 90 degrees of total bend by one cable

The arm hangs, mu_c = {CAPSTAN_FRICTION:g}, and cable 1 is pulled slowly until the joints' angles add up to 90 degrees:
{bend.tension:.1f} N. The thesis shows this as Fig. 10 and prints no numbers.

| joint angle [deg] | {joints} |
|---|{"---|" * n}
| constant curvature | {_cells(_degrees(bend.even))} |
| dynamic model, pulled slowly | {_cells(_degrees(bend.pulled))} |
| equilibrium with the cable's losses ({bend.resting.load.tension[0]:.1f} N) | {_cells(_degrees(bend.resting.theta))} |
| smallest angle that dry friction holds | {_cells(_degrees(bend.zone.lower))} |
| largest | {_cells(_degrees(bend.zone.upper))} |

The last two rows are each joint's extremes over all postures in which no joint is pulled by more than its break-away
torque of {bend.zone.break_away[0]:.3f} N m; they are not reached together. The cable's losses are those of the pull in
all of them: under the same tension an arm that came back from a larger bend rests at
{np.degrees(bend.returning.theta.sum()):.0f} degrees in total, and what the discs hold lets it stay between.

The dynamic model bends less near the base, which carries the weight of all links beyond it, than near the tip, in spite
of what the cable loses on the way. Its tip is {np.linalg.norm(even_tip - pulled_tip):.0f} mm from that of constant
curvature.

![Joint angles and backbone at 90 degrees](pictures/reproduction_bend.png)

Fig. 10's measured angles were not published, but repetition 7 was released from such a posture: the first row of the
author's simulation, {released.sum():.1f} degrees in total, to the other side. The same pull to that bend:

| joint angle [deg] | {joints} | distance, rms |
|---|{"---|" * (n + 1)}
| repetition 7, where it is let go | {_cells(f"{x:.1f}" for x in released)} | |
| constant curvature | {_cells(_degrees(as_released.even))} | {_apart(as_released.even, inside):.1f} |
| dynamic model, pulled slowly | {_cells(_degrees(as_released.pulled))} | {_apart(as_released.pulled, inside):.1f} |

The dynamic model is the closer one, as the thesis says. {_outside(outside)}
"""


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


def _apart(one: Array, other: Array) -> float:
    return float(np.degrees(np.sqrt(np.mean((one - other) ** 2))))


def _outside(joints: Array) -> str:
    if joints.size == 0:
        return "What is left, dry friction alone could hold in the model."
    names = " and ".join(str(joint) for joint in joints)
    return f"What is left is more than dry friction could hold in the model at joint {names}."
