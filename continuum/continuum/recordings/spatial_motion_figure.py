"""The motion of an arm in space as a picture: bends of the sections, path of the tip, the arm at a few instants."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.figure import Figure

from continuum.arrays import Array
from continuum.dynamics.spatial.arm_model import ArmModel
from continuum.dynamics.spatial.simulation import CableCommands, SpatialMotion, tip_poses
from continuum.dynamics.spatial.terms import body_poses
from continuum.whole_file import write_figure

_INSTANTS = 6
"""Postures shown."""

_OUTSIDE: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.0, 1.0), "fontsize": 8, "frameon": False}
"""Legends are to the right of their panel."""


def write_spatial_figure(
    model: ArmModel, motion: SpatialMotion, commands: CableCommands | None, path: str | Path
) -> None:
    """Draw the picture and write it.

    Raises:
        FileError: the file cannot be written, or its format is not known.
    """
    figure = Figure(figsize=(12.5, 6.6), layout="constrained")
    rows = ["bends", "tip"] + ([] if commands is None or not np.ptp(commands.values) else ["commands"])
    panels = figure.subplot_mosaic(
        [[name, "arm"] for name in rows], width_ratios=(1.4, 1), per_subplot_kw={"arm": {"projection": "3d"}}
    )
    bends = np.degrees(model.bends(motion.q))
    for k, section in enumerate(model.arm.sections):
        u, v = bends[:, k].T
        (line,) = panels["bends"].plot(motion.times, v, linewidth=1.3, label=f"{section.name}, towards x")
        panels["bends"].plot(motion.times, -u, "--", color=line.get_color(), linewidth=1.3, label="towards y")
    tips = 1e3 * tip_poses(model, motion.q)[0]
    for axis, column in zip("xyz", tips.T, strict=True):
        panels["tip"].plot(motion.times, column - column[0], linewidth=1.3, label=axis)
    panels["bends"].set(title="Bend of the sections", ylabel="[deg]")
    panels["tip"].set(title="Motion of the tip from its start", ylabel="[mm]")
    if commands is not None and "commands" in rows:
        values, unit = (1e3 * commands.over(motion.times), "mm") if commands.holds_length.any() else (
            commands.over(motion.times), "N")  # fmt: skip
        for name, column in zip(model.cable_names, values.T, strict=True):
            if np.ptp(column) or unit == "N":
                panels["commands"].plot(motion.times, column, linewidth=1.0, label=name if column.any() else None)
        panels["commands"].set(title="Commands of the cables", ylabel=f"[{unit}]")
    panels[rows[-1]].set(xlabel="time [s]")
    for name in rows:
        panels[name].grid(alpha=0.3)
        panels[name].margins(x=0.01)
        panels[name].legend(**_OUTSIDE)
    _draw_arm(panels["arm"], model, motion, tips)
    write_figure(path, figure, dpi=100)


def _draw_arm(axes: Any, model: ArmModel, motion: SpatialMotion, tips: Array) -> None:
    """Draw joints and tip at a few instants, later ones darker, with gravity downwards, and the path of the tip."""
    down = model.chain.gravity / max(np.linalg.norm(model.chain.gravity), 1e-9)
    turned = down[2] > 0.5  # the arm hangs: z points down
    shown = np.unique(np.linspace(0, len(motion.times) - 1, _INSTANTS).astype(int))
    origins = 1e3 * body_poses(model.chain, np.ascontiguousarray(motion.q[shown]))[0][:, 1::2]
    shades = colormaps["viridis"](np.linspace(0.9, 0.0, shown.size))
    for joints, tip, colour, i in zip(origins, tips[shown], shades, shown, strict=True):
        points = np.vstack([np.zeros(3), joints, tip])
        axes.plot(*points.T, "o-", color=colour, markersize=2.5, linewidth=1.6, label=f"{motion.times[i]:.2f} s")
    axes.plot(*tips.T, color="#d03030", linewidth=1.0, label="tip")
    axes.set_aspect("equal")
    if turned:
        axes.invert_zaxis()
        axes.invert_yaxis()
    axes.set(
        title="The arm, gravity downwards" if turned else "The arm", xlabel="x [mm]", ylabel="y [mm]", zlabel="z [mm]"
    )
    axes.legend(fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
