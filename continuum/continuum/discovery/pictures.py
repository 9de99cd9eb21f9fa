"""Pictures of a diagnosis: joint angles measured and simulated open loop, and the missing torque."""

from __future__ import annotations

import io
from typing import Any, Protocol

import numpy as np
from matplotlib.figure import Figure

from continuum.arrays import Array
from continuum.discovery.fitted import OpenLoop
from continuum.recordings.recording import Recording

MEASURED, REFITTED, EXTENDED = "#222222", "#d1802b", "#1f6fb4"
_LEGEND_HEIGHT = 0.25  # in, kept free for it: loc="outside ..." is not known to Matplotlib before 3.7


class Simulated(Protocol):
    """What pictures need of a diagnosis: recordings, open-loop simulations, missing torque; before and after."""

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


def angles(result: Simulated) -> Figure:
    """Joint angles of every recording: measured, and simulated open loop by the refitted and the extended model."""
    n, runs = result.recordings[0].n_joints, result.recordings
    figure = Figure(figsize=(2.3 * n, 1.7 * len(runs) + 0.3), layout="constrained")
    axes = figure.subplots(len(runs), n, sharex="row", squeeze=False)
    for r, (row, run) in enumerate(zip(axes, runs, strict=True)):
        for joint, ax in enumerate(row):
            ax.plot(run.times, np.rad2deg(run.theta[:, joint]), color=MEASURED, lw=1.6, label="measured")
            ax.plot(run.times, np.rad2deg(result.before.angles[r][:, joint]), color=REFITTED, lw=0.9, label="refitted")
            if result.is_extended:
                after = np.rad2deg(result.after.angles[r][:, joint])
                ax.plot(run.times, after, color=EXTENDED, lw=0.9, label="extended")
            ax.tick_params(labelsize=6)
            if r == 0:
                ax.set_title(f"joint {joint + 1}", fontsize=8)
        row[0].set_ylabel(f"{run.name}\n[deg]", fontsize=7)
    _legend(figure, axes[0, 0])
    for ax in axes[-1]:
        ax.set_xlabel("time [s]", fontsize=7)
    return figure


def torques(result: Simulated) -> Figure:
    """Missing torque at every joint over its angle and over time, before and after."""
    n = result.recordings[0].n_joints
    figure = Figure(figsize=(2.3 * n, 4.0), layout="constrained")
    axes = figure.subplots(2, n, sharey="row", squeeze=False)
    shown = [(result.missing[0], REFITTED, "refitted")]
    if result.is_extended:
        shown.append((result.missing[1], EXTENDED, "extended"))
    for courses, color, label in shown:
        for joint in range(n):
            for run, course in zip(result.recordings, courses, strict=True):
                missing = 1e3 * course[:, joint]
                axes[0, joint].plot(np.rad2deg(run.theta[:, joint]), missing, ".", ms=2, color=color, alpha=0.4)
                axes[1, joint].plot(run.times, missing, color=color, lw=0.7, alpha=0.7, label=label)
    for joint in range(n):
        axes[0, joint].set_title(f"joint {joint + 1}", fontsize=8)
        axes[0, joint].set_xlabel("angle [deg]", fontsize=7)
        axes[1, joint].set_xlabel("time [s]", fontsize=7)
        for ax in axes[:, joint]:
            ax.axhline(0, color="#999999", lw=0.5)
            ax.tick_params(labelsize=6)
    for ax in axes[:, 0]:
        ax.set_ylabel("missing torque [mN m]", fontsize=7)
    _legend(figure, axes[1, 0])
    return figure


def overview(result: Simulated) -> Figure:
    """Angles of the recording that the refitted model simulates worst, above the missing torque there."""
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


def png(figure: Figure) -> bytes:
    """The figure as a file."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=110)
    return buffer.getvalue()


def _legend(figure: Figure, ax: Any) -> None:
    handles, labels = ax.get_legend_handles_labels()
    by_label = dict(zip(labels, handles, strict=True))
    figure.set_layout_engine("constrained", rect=(0, 0, 1, 1 - _LEGEND_HEIGHT / figure.get_figheight()))
    figure.legend(by_label.values(), by_label.keys(), loc="upper right", ncols=3, fontsize=7, frameon=False)
