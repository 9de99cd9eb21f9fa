"""Fig. 8 of the thesis: total cable lengths; cable rates from the Jacobian over finite differences of the lengths."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from continuum.cable_colours import cable_colour
from continuum.recordings.arm_recording import ArmRecording
from continuum.recordings.kinematic_report import central_differences
from continuum.whole_file import write_figure

_STYLES = ("-", "--", ":", "-.")
_DOTS = 60  # finite differences shown per cable; all of them would hide the lines


def write_cable_figure(recording: ArmRecording, path: str | Path) -> None:
    """Draw the picture and write it to ``path`` (PNG or any format that Matplotlib knows by its suffix).

    Raises:
        FileError: it cannot be written, or its format is not known.
    """
    figure = Figure(figsize=(13, 5.4))
    length_axes, rate_axes = figure.subplots(1, 2)
    stamps = recording.lengths.stamps
    times = (stamps - stamps[0]) * 1e-9
    inner, derivatives = central_differences(stamps, recording.lengths.values)
    shown = np.linspace(0, len(inner) - 1, min(_DOTS, len(inner))).astype(int)
    column = 0
    for i, section in enumerate(recording.arm.sections):
        for j in range(len(section.cable_azimuths)):
            line = {
                "color": cable_colour(j),
                "linestyle": _STYLES[i % len(_STYLES)],
                "label": f"section {i + 1}, cable {j + 1}",
            }
            length_axes.plot(times, 1e3 * recording.lengths.values[:, column], linewidth=1.2, **line)
            rate_axes.plot(times, 1e3 * recording.rates.values[:, column], linewidth=1.0, **line)
            rate_axes.plot(
                times[inner[shown]],
                1e3 * derivatives[shown, column],
                ".",
                markersize=3.5,
                color=line["color"],
                alpha=0.8,
            )
            column += 1
    length_axes.set(title="Total cable lengths", xlabel="time [s]", ylabel="length [mm]")
    rate_axes.set(
        title="Cable rates: Jacobian (lines), finite differences (dots)", xlabel="time [s]", ylabel="rate [mm/s]"
    )
    for axes in (length_axes, rate_axes):
        axes.grid(alpha=0.3)
        axes.margins(x=0.01)
    handles, labels = length_axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=recording.arm.n_sections * 2, fontsize=8)
    figure.subplots_adjust(left=0.05, right=0.985, top=0.94, bottom=0.23, wspace=0.13)
    write_figure(path, figure, dpi=90)
