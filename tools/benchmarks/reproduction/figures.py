"""Pictures of the reproduction."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from continuum.whole_file import write_figure
from tools.benchmarks.reproduction.release import Release

_MEASURED, _PUBLISHED, _OURS = "0.55", "tab:orange", "tab:blue"


def draw_release(release: Release, path: Path) -> None:
    """Draw joint angles over time, and the differences between ours and the author's."""
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
