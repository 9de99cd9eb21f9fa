"""The picture of the page: joint angles measured and simulated."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from continuum.whole_file import write_figure
from tools.benchmarks.prototype.account import Account

_MEASURED, _THESIS, _REFITTED, _EXTENDED = "0.55", "tab:orange", "tab:green", "tab:blue"


def draw(account: Account, path: Path) -> None:
    """One panel a joint."""
    result, (run,) = account.diagnosis, account.diagnosis.recordings
    figure = Figure(figsize=(11.0, 3.2), layout="constrained")
    panels = figure.subplots(1, run.n_joints, sharex=True)
    lines = [
        ("measured", run.theta, _MEASURED, 3.0),
        ("simulated: the thesis's parameters", account.thesis, _THESIS, 1.2),
        ("the same parameters, refitted", result.before.angles[0], _REFITTED, 1.2),
    ]
    if result.is_extended:
        lines.append(("with what the discovery adds", result.after.angles[0], _EXTENDED, 1.2))
    for joint, panel in enumerate(panels):
        for name, theta, color, width in lines:
            panel.plot(run.times, np.degrees(theta[:, joint]), color=color, linewidth=width, label=name)
        panel.set_title(f"joint {joint + 1}", fontsize="medium")
        panel.set_xlabel("t [s]")
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("angle [deg]")
    figure.legend(*panels[0].get_legend_handles_labels(), ncols=4, loc="outside upper center", fontsize="small")
    write_figure(path, figure, dpi=90)
