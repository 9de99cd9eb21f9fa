"""Pictures of the reproduction."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from continuum.whole_file import write_figure
from tools.reproduction.bend import Bend, joint_positions
from tools.reproduction.release import Release

_MEASURED, _PUBLISHED, _OURS, _EVEN = "0.55", "tab:orange", "tab:blue", "tab:green"


def draw_release(release: Release, path: Path) -> None:
    """Joint angles over time, and how far ours are from the author's."""
    figure = Figure(figsize=(11.0, 8.0), layout="constrained")
    axes = figure.subplots(5, 2, sharex=True, sharey="col", width_ratios=[2, 1])
    times = release.published.times
    ours = {"from rest": (release.from_rest, ":"), "initial rates free": (release.thrown, "-")}
    for joint, (angle, error) in enumerate(axes):
        angle.plot(times, np.degrees(release.measured.theta[:, joint]), color=_MEASURED, label="measured")
        published = np.degrees(release.published.theta[:, joint])
        angle.plot(times, published, color=_PUBLISHED, linewidth=3, label="the author's simulation")
        for name, (run, style) in ours.items():
            theta = np.degrees(run.theta[:, joint])
            angle.plot(times, theta, style, color=_OURS, linewidth=1.2, label=f"ours, {name}")
            error.plot(times, theta - published, style, color=_OURS, linewidth=1.2)
        angle.set_ylabel(f"joint {joint + 1} [deg]")
        for panel in (angle, error):
            panel.grid(alpha=0.3)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), ncols=4, loc="outside upper center")
    axes[0, 1].set_title("ours less the author's [deg]", fontsize="medium")
    for panel in axes[-1]:
        panel.set_xlabel("t [s]")
    write_figure(path, figure, dpi=110)


def draw_bend(bend: Bend, path: Path) -> None:
    """The thesis's Fig. 10: joint angles at one total bend, and the backbones."""
    figure = Figure(figsize=(10.0, 4.6), layout="constrained")
    angles, backbone = figure.subplots(1, 2, width_ratios=[1.2, 1])
    joints = np.arange(1, bend.pulled.size + 1)
    resting = np.degrees(bend.resting.theta)
    reach = np.degrees(np.stack([bend.resting.theta - bend.zone.lower, bend.zone.upper - bend.resting.theta]))
    angles.plot(joints, np.degrees(bend.even), "s--", color=_EVEN, label="constant curvature")
    angles.errorbar(
        joints + 0.08, resting, reach, fmt=".", color="0.6", capsize=4, label="equilibrium, and what dry friction holds"
    )
    angles.plot(joints, np.degrees(bend.pulled), "o-", color=_OURS, label="dynamic model, pulled slowly")
    angles.set(xlabel="joint", ylabel="joint angle [deg]", xticks=joints, ylim=(0.0, None))
    angles.grid(alpha=0.3)
    angles.legend(fontsize="small", loc="upper left")
    for theta, style, color, name in (
        (bend.even, "s--", _EVEN, "constant curvature"),
        (bend.pulled, "o-", _OURS, "dynamic model"),
    ):
        x, z = 1e3 * joint_positions(theta, float(bend.model.parameters.half_spacing[0])).T
        backbone.plot(x, z, style, color=color, label=name, markevery=slice(1, -1))
        backbone.plot(x[-1], z[-1], "D", color=color)
    backbone.set(xlabel="x [mm]", ylabel="z, downwards [mm]", aspect="equal")
    backbone.invert_yaxis()
    backbone.grid(alpha=0.3)
    backbone.legend(fontsize="small")
    write_figure(path, figure, dpi=110)
