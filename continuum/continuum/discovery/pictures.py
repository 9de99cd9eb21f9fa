"""Pictures of a diagnosis as PNG: measured against simulated, missing torque, evidence."""

from __future__ import annotations

import io
from collections.abc import Sequence
from textwrap import fill

import numpy as np
from matplotlib.figure import Figure

from continuum.discovery.evidence import gain
from continuum.discovery.measured_gain import RunScore
from continuum.discovery.residual_torque import ResidualTorque
from continuum.discovery.round import Round

_BEFORE, _AFTER, _MEASURED = "#d1802b", "#1f6fb4", "#222222"
_LABEL = 22  # characters that a row is high


def runs_picture(before: Sequence[RunScore], after: Sequence[RunScore], extended: bool) -> bytes:
    """Joint angles of every run: measured, and predicted by models that were fitted to other runs."""
    n = before[0].recording.n_joints
    figure = Figure(figsize=(2.3 * n, 1.7 * len(before)), layout="constrained")
    axes = np.atleast_2d(figure.subplots(len(before), n, sharex="row", squeeze=False))
    for row, (old, new) in enumerate(zip(before, after, strict=True)):
        for joint in range(n):
            ax, t = axes[row, joint], old.recording.times
            ax.plot(t, np.rad2deg(old.recording.theta[:, joint]), color=_MEASURED, lw=1.6, label="measured")
            if old.seen is not None:
                ax.plot(t, np.rad2deg(old.seen.theta[:, joint]), color=_BEFORE, lw=0.9, label="refitted")
            if extended and new.seen is not None:
                ax.plot(t, np.rad2deg(new.seen.theta[:, joint]), color=_AFTER, lw=0.9, label="extended")
            ax.tick_params(labelsize=6)
            if row == 0:
                ax.set_title(f"joint {joint + 1}", fontsize=8)
        axes[row, 0].set_ylabel(f"{fill(old.name, _LABEL)}\n[deg]", fontsize=7)
    lines = axes[0, 0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside upper right", ncols=3, fontsize=7, frameon=False)
    for ax in axes[-1]:
        ax.set_xlabel("time [s]", fontsize=7)
    return _png(figure)


def torque_picture(before: Sequence[ResidualTorque], after: Sequence[ResidualTorque] | None) -> bytes:
    """Missing torque of every joint against its angle and its rate."""
    n = before[0].torque.shape[1]
    figure = Figure(figsize=(2.3 * n, 4.0), layout="constrained")
    axes = figure.subplots(2, n, sharey="row", squeeze=False)
    for residuals, color, label in ((before, _BEFORE, "refitted"), (after, _AFTER, "extended")):
        for joint in range(n if residuals else 0):
            told = np.concatenate([r.is_told[:, joint] for r in residuals or ()])
            torque = 1e3 * np.concatenate([r.torque[:, joint] for r in residuals or ()])[told]
            for row, what in enumerate(("theta", "theta_rate")):
                x = np.rad2deg(np.concatenate([getattr(r, what)[:, joint] for r in residuals or ()]))[told]
                axes[row, joint].plot(x, torque, ".", ms=3, color=color, alpha=0.6, label=label)
    shown = np.concatenate([np.abs(r.torque[r.is_told]) for r in before])
    limit = 1.3e3 * max(1e-3, float(np.quantile(shown, 0.97)) if shown.size else 0.0)
    for joint in range(n):
        axes[0, joint].set_title(f"joint {joint + 1}", fontsize=8)
        for row, what in enumerate(("angle [deg]", "rate [deg/s]")):
            axes[row, joint].set_xlabel(what, fontsize=7)
            axes[row, joint].set_ylim(-limit, limit)
            axes[row, joint].axhline(0, color="#999999", lw=0.5)
            axes[row, joint].tick_params(labelsize=6)
    for row in (0, 1):
        axes[row, 0].set_ylabel("missing torque [mN m]", fontsize=7)
    axes[0, 0].legend(fontsize=6, frameon=False)
    return _png(figure)


def evidence_picture(one: Round) -> bytes:
    """What each leading effect gains on runs that were held out, with its standard deviation."""
    gains = [gain(trial, one.before) for trial in one.leaders]
    figure = Figure(figsize=(6.0, 0.6 + 0.35 * len(gains)), layout="constrained")
    ax = figure.subplots()
    names = [str(trial.extension[-1]) for trial in one.leaders]
    ax.barh(names, [g.log_likelihood for g in gains], xerr=[g.deviation for g in gains], color=_AFTER, height=0.6)
    ax.invert_yaxis()
    ax.axvline(0, color=_MEASURED, lw=0.6)
    ax.set_xlabel("gain in log-likelihood on held-out runs", fontsize=8)
    ax.tick_params(labelsize=7)
    return _png(figure)


def _png(figure: Figure) -> bytes:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=110)
    return buffer.getvalue()
