"""A simulated motion as a picture: joint angles, joint rates, tensions or torques if any, the arm at a few instants."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from continuum.arrays import Array
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.model import InputKind
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.backbone import backbone
from continuum.dynamics.trajectory import Trajectory
from continuum.whole_file import write_figure

_INSTANTS = 6
"""Postures shown."""

_OUTSIDE: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0), "fontsize": 8, "frameon": False}
"""Legends are to the right of their panel."""


def write_motion_figure(motion: Trajectory, inputs: InputSignal, p: Parameters, path: str | Path) -> None:
    """Draw the picture and write it to ``path`` (PNG or any format that Matplotlib knows by its suffix).

    Raises:
        FileError: the file cannot be written, or its format is not known.
    """
    driven, pulled = inputs.over(motion.times), inputs.kind is InputKind.CABLES
    drives = np.any(driven > 0) if pulled else np.any(driven)
    heights = {"angles": 1.5, "rates": 1.2} | ({"inputs": 0.8} if drives else {})
    figure = Figure(figsize=(12.5, 6.6), layout="constrained")
    panels = figure.subplot_mosaic(
        [[name, "arm"] for name in heights], width_ratios=(1.7, 1), height_ratios=list(heights.values())
    )
    colours = _shades(motion.n_joints)
    for name, values in (("angles", motion.theta), ("rates", motion.theta_rate)):
        for joint, column in enumerate(np.degrees(values).T):
            panels[name].plot(motion.times, column, color=colours[joint], linewidth=1.3, label=f"joint {joint + 1}")
    if motion.n_joints <= 12:
        panels["angles"].legend(**_OUTSIDE, title="from the base", title_fontsize=8)
    if drives and pulled:
        _draw_tensions(panels["inputs"], motion.times, driven)
    elif drives:
        for colour, column in zip(colours, driven.T, strict=True):
            panels["inputs"].plot(motion.times, column, color=colour, linewidth=1.3)
        panels["inputs"].set(title="Joint torques", ylabel="[N m]")
    panels["angles"].set(title="Joint angles", ylabel="[deg]")
    panels["rates"].set(title="Joint rates", ylabel="[deg/s]")
    panels[list(heights)[-1]].set(xlabel="time [s]")
    for name in heights:
        panels[name].grid(alpha=0.3)
        panels[name].margins(x=0.01)
    _draw_arm(panels["arm"], motion, p)
    write_figure(path, figure, dpi=100)


def _draw_tensions(axes: Axes, times: Array, pull: Array) -> None:
    """Draw the tension of each cable at the base, (n_times, n_cables) [N]."""
    for cable, (colour, column) in enumerate(zip(("#202020", "#b07800"), pull.T, strict=True)):
        axes.plot(times, column, color=colour, linewidth=1.3, label=f"cable {cable + 1}")
    axes.legend(**_OUTSIDE)
    axes.set_ylim(0, max(1.0, 1.15 * float(pull.max())))
    axes.set(title="Cable tensions at the base", ylabel="[N]")


def _draw_arm(axes: Axes, motion: Trajectory, p: Parameters) -> None:
    """Draw joints and tip in the plane, with gravity downwards and later instants darker."""
    shown = np.unique(np.linspace(0, len(motion.times) - 1, _INSTANTS).astype(int))
    for i, colour in zip(shown, _shades(len(shown)), strict=True):
        points = 1e3 * backbone(motion.theta[i], p)
        axes.plot(*points.T, "o-", color=colour, markersize=3.5, linewidth=1.6, label=f"{motion.times[i]:.2f} s")
    axes.plot(0, 0, "ks", markersize=9)
    axes.set(title="The arm, seen across its plane", xlabel="[mm]", ylabel="[mm], gravity downwards", aspect="equal")
    axes.grid(alpha=0.3)
    axes.margins(0.08)
    axes.legend(fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=3)


def _shades(n: int) -> Array:
    """Return colours from light to dark, (n, 3)."""
    share = np.linspace(0, 1, max(n, 2))[:n, None]
    return np.asarray((1 - share) * np.array([0.55, 0.78, 0.95]) + share * np.array([0.05, 0.12, 0.45]))
