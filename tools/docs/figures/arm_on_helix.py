"""The arm on the helix: discs, cables coloured as in the thesis's Fig. 14, and the path of the tip."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.cable_colours import cable_colour
from continuum.kinematics.cable_lines import cable_lines
from continuum.kinematics.discs import even_bends
from continuum.recordings.arm_recording import ArmRecording
from continuum.whole_file import write_figure
from tools.docs.figures.posture import backbone, discs

_NOW = 0.8
_BEFORE = (0.25, 0.55)
"""Fractions of the run, 0 to 1, at which the arm is drawn, and before that only its backbone."""

_MM = 1e3


def draw_arm(run: ArmRecording, path: Path) -> None:
    """Write the picture."""
    figure = Figure(figsize=(6.4, 5.6))
    with rc_context({"grid.color": "0.9"}):
        axes: Any = figure.add_axes((-0.04, 0.03, 1.03, 1.05), projection="3d", computed_zorder=False)
    now, *before = (round(part * (len(run.targets.stamps) - 1)) for part in (_NOW, *_BEFORE))
    helix = _MM * run.targets.values
    axes.plot(*helix[now:].T, color="0.7", linewidth=1.0, linestyle="--", label="helix, still to come", zorder=1)
    axes.plot(*helix[: now + 1].T, color="tab:orange", linewidth=1.8, label="the tip's way", zorder=2)
    for number, row in enumerate(before):
        line = _MM * backbone(run.configurations.values[row], run.arm)
        label = "the arm before" if number == 0 else None
        axes.plot(*line.T, color="0.72", linewidth=3.0, alpha=0.4 + 0.2 * number, label=label, zorder=3)
    _draw_posture(axes, run.configurations.values[now], run.arm)
    axes.plot(*helix[now], "o", color="tab:orange", markersize=8, markeredgecolor="black", label="target", zorder=9)
    axes.set(xlabel="x [mm]", ylabel="y [mm]", zlabel="z [mm]", aspect="equal")
    axes.view_init(elev=22, azim=-62)
    axes.tick_params(labelsize=7)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_pane_color((1.0, 1.0, 1.0))
        axis.line.set_color("0.6")
    figure.legend(loc="upper left", bbox_to_anchor=(0.02, 0.98), fontsize="small")
    write_figure(path, figure, dpi=110)


def _draw_posture(axes: Any, w: Array, arm: Arm) -> None:
    axes.add_collection3d(
        Poly3DCollection(
            _MM * discs(w, arm), facecolor=(0.6, 0.65, 0.75, 0.25), edgecolor="0.45", linewidth=0.7, zorder=4
        )
    )
    axes.plot(*(_MM * backbone(w, arm)).T, color="0.35", linewidth=3.0, zorder=5)
    bends = [even_bends(bent, section) for bent, section in zip(w, arm.sections, strict=True)]
    for line in cable_lines(bends, arm):
        width = 0.6 if line.passing else 1.4
        axes.plot(*(_MM * line.points).T, color=cable_colour(line.colour_index), linewidth=width, zorder=6)
