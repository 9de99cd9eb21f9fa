"""Fig. 10 of the thesis: joint angles at one total bend, and the backbone in the plane."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from continuum.arrays import Array
from continuum.curvature.comparison import Comparison
from continuum.dynamics.planar.backbone import backbone
from continuum.whole_file import write_figure

_MEASURED, _CONSTANT, _DYNAMIC = "black", "#1b7837", "#2166ac"
_SIZE, _FONT = (5.6, 8.2), 11.5  # inches, points: letters of 11 pixels where the picture is 390 pixels wide
_MANY = 12  # joints, above which not every one is numbered


def write_curvature_figure(one: Comparison, path: str | Path, title: str = "") -> None:
    """Draw the picture in portrait format, so that it fits a narrow screen too.

    Raises:
        FileError: it cannot be written, or its format is not known.
    """
    with rc_context({"font.size": _FONT, "legend.fontsize": _FONT - 1, "figure.titlesize": _FONT}):
        figure = Figure(figsize=_SIZE, layout="constrained")
        angles, plane = figure.subplots(2, 1, height_ratios=[1.0, 1.05])
        if title:
            figure.suptitle(title)
        _draw_angles(angles, one)
        _draw_backbones(plane, one)
        write_figure(path, figure, dpi=150)


def _draw_angles(axes: Axes, one: Comparison) -> None:
    joints, zone = np.arange(1, one.theta.size + 1), one.held.zone
    theta, constant, dynamic = (np.degrees(values) for values in (one.theta, one.constant, one.held.theta))
    for joint, low, high in zip(joints, np.degrees(zone.lower), np.degrees(zone.upper), strict=True):
        axes.fill_between([joint - 0.22, joint + 0.22], low, high, color=_DYNAMIC, alpha=0.18, linewidth=0)
    axes.fill_between([], [], [], color=_DYNAMIC, alpha=0.18, linewidth=0, label="held by dry friction")
    axes.plot(joints, constant, "s--", color=_CONSTANT, label="constant curvature")
    axes.plot(joints, dynamic, "o-", color=_DYNAMIC, label="dynamic model")
    reach = np.degrees(one.quantiles[1]) - theta
    axes.errorbar(joints, theta, reach, fmt="D", color=_MEASURED, markersize=5, capsize=5, label="measured, 95 %")
    axes.set(xlabel="joint", ylabel="joint angle [degrees]")
    axes.set_xticks(joints if joints.size <= _MANY else joints[:: joints.size // 10])
    axes.grid(alpha=0.3)
    axes.margins(y=0.12)
    axes.legend()


def _draw_backbones(axes: Axes, one: Comparison) -> None:
    off = {name: 1e3 * found.value for name, found in (("c", one.tip_to_constant), ("d", one.tip_to_dynamic))}
    _draw_backbone(axes, one, one.constant, "s--", _CONSTANT, f"constant curvature, tip {off['c']:.1f} mm off")
    _draw_backbone(axes, one, one.held.theta, "o-", _DYNAMIC, f"dynamic model, tip {off['d']:.1f} mm off")
    _draw_backbone(axes, one, one.theta, "D-", _MEASURED, "measured")
    axes.plot(0, 0, "s", color="0.3", markersize=11)
    axes.set(xlabel="[mm]", ylabel="[mm], gravity downwards", aspect="equal", adjustable="datalim")
    axes.grid(alpha=0.3)
    axes.legend()


def _draw_backbone(axes: Axes, one: Comparison, theta: Array, style: str, colour: str, label: str) -> None:
    x, z = 1e3 * backbone(theta, one.p).T
    axes.plot(x, z, style, color=colour, markersize=5, linewidth=1.6, label=label, markevery=slice(1, None))
