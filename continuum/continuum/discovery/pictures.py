"""A picture of a diagnosis: joint angles measured and simulated open loop, and the missing torque."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from matplotlib.figure import Figure

from continuum.arrays import Array
from continuum.discovery.fit_result import OpenLoop
from continuum.recordings.recording import Recording

MEASURED, REFITTED, EXTENDED = "#222222", "#d1802b", "#1f6fb4"
_LEGEND_HEIGHT = 0.25  # in, space for the legend: Matplotlib before 3.7 lacks loc="outside ..."


class Simulated(Protocol):
    """What pictures need of a diagnosis: recordings, open-loop simulations and missing torque, before and after."""

    @property
    def recordings(self) -> tuple[Recording, ...]: ...
    @property
    def before(self) -> OpenLoop: ...
    @property
    def after(self) -> OpenLoop: ...
    @property
    def missing(self) -> tuple[tuple[Array, ...], tuple[Array, ...]]: ...
    @property
    def is_extended(self) -> bool: ...


def overview(result: Simulated) -> Figure:
    """Plot the angles of the recording that the refitted model simulates worst, above its missing torque."""
    worst = int(np.nanargmax([result.before.error(r, run.theta) for r, run in enumerate(result.recordings)]))
    run, n = result.recordings[worst], result.recordings[0].n_joints
    figure = Figure(figsize=(2.3 * n, 4.0), layout="constrained")
    axes = figure.subplots(2, n, sharex=True, sharey="row", squeeze=False)
    for joint in range(n):
        axes[0, joint].plot(run.times, np.rad2deg(run.theta[:, joint]), color=MEASURED, lw=1.6, label="measured")
        for simulated, missing, color, label in (
            (result.before, result.missing[0], REFITTED, "refitted"),
            (result.after, result.missing[1], EXTENDED, "extended"),
        ):
            if label == "extended" and not result.is_extended:
                continue
            axes[0, joint].plot(
                run.times, np.rad2deg(simulated.angles[worst][:, joint]), color=color, lw=0.9, label=label
            )
            axes[1, joint].plot(run.times, 1e3 * missing[worst][:, joint], color=color, lw=0.9)
        axes[0, joint].set_title(f"joint {joint + 1}", fontsize=8)
        axes[1, joint].set_xlabel("time [s]", fontsize=7)
    axes[0, 0].set_ylabel(f"{run.name}, angle [deg]", fontsize=7)
    axes[1, 0].set_ylabel("missing torque [mN m]", fontsize=7)
    _legend(figure, axes[0, 0])
    return figure


def _legend(figure: Figure, ax: Any) -> None:
    handles, labels = ax.get_legend_handles_labels()
    by_label = dict(zip(labels, handles, strict=True))
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 1 - _LEGEND_HEIGHT / figure.get_figheight()))
    figure.legend(by_label.values(), by_label.keys(), loc="upper right", ncols=3, fontsize=7, frameon=False)
