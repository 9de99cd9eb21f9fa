"""Data of the plots of one section: angles of its joints, lengths and tensions of its cables, line by line."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arm import Section
from continuum.arrays import Array
from continuum.cable_colours import Colour, cable_colour
from continuum.viewer.tracks import NOTHING, Track

THETA, PHI = "Bend theta [deg]", "Direction phi [deg]"
LENGTHS, TENSIONS = "Cable lengths [mm]", "Cable tensions [N]"


@dataclass(frozen=True)
class Motion:
    """Joint angles over time, with label and colour.

    Attributes:
        label: label in legends; empty for the name of what is plotted.
        joints: joint angles [rad].
        colour: colour in plots.
    """

    label: str
    joints: Track
    colour: Colour


@dataclass(frozen=True)
class Line:
    """One line of a plot.

    Attributes:
        label: label in the legend.
        colour: colour on a light page.
    """

    label: str
    colour: Colour


@dataclass(frozen=True)
class PlotData:
    """Lines of one plot.

    Attributes:
        lines: lines.
        times: increasing times, (n,) [s].
        values: values of each line, (n_lines, n), NaN where it is not drawn.
    """

    lines: tuple[Line, ...]
    times: Array
    values: Array


def section_data(
    section: Section, motions: Sequence[Motion], lengths: Track = NOTHING, tensions: Track = NOTHING
) -> dict[str, PlotData]:
    """Return the data of all plots of a section by title, for the quantities that are known.

    If only the first of several joints is named, the others have its angle: the bend theta of the section is plotted.
    """
    data: dict[str, PlotData] = {}
    named = [name for name in section.theta_joints if any(name in motion.joints.names for motion in motions)]
    if named == [section.theta_joints[0]] and section.n_joints > 1:
        data[THETA] = _compared("theta", named[0], motions, section.n_joints)
    else:
        for name in named:
            number = section.theta_joints.index(name) + 1
            data[f"Joint {number} [deg]"] = _compared(f"joint {number}", name, motions)
    if any(section.phi_joint in motion.joints.names for motion in motions):
        data[PHI] = _compared("phi", section.phi_joint, motions)
    for title, track, factor in ((LENGTHS, lengths, 1e3), (TENSIONS, tensions, 1.0)):
        cables = {name: j for j, name in enumerate(section.cable_names) if name in track.names}
        if cables:
            columns = [track.names.index(name) for name in cables]
            lines = tuple(Line(f"cable {j + 1}", cable_colour(j)) for j in cables.values())
            data[title] = PlotData(lines, track.times, factor * track.values.T[columns])
    return data


def track_of(times: Array, rows: Sequence[Mapping[str, float]], wanted: Iterable[str]) -> Track:
    """Return a track of the ``wanted`` names that the last of ``rows`` has; rows that lack one of them are omitted."""
    names = tuple(name for name in wanted if name in rows[-1])
    whole = [i for i, row in enumerate(rows) if all(name in row for name in names)]
    return Track(times[whole], names, np.array([[rows[i][name] for name in names] for i in whole]))


def padded(data: PlotData, end: float) -> PlotData:
    """Return data from 0 to ``end`` [s], for equal time axes of all plots; NaN before the first and after the last."""
    inside = (data.times >= 0.0) & (data.times <= end)
    times = np.unique([0.0, *data.times[inside], end])
    return PlotData(data.lines, times, np.array([_within(times, data.times, line) for line in data.values]))


def thinned(data: PlotData, most: int) -> PlotData:
    """Return at most ``most`` points, an even number, that keep the smallest and largest value of each interval.

    Each interval has two points; a value within it may move in time by less than its length. NaN remains only where an
    interval has no value.
    """
    n = data.times.size
    if n <= most:
        return data
    bounds = np.linspace(0, n, most // 2 + 1).astype(int)[:-1]
    middles = bounds + np.diff(np.append(bounds, n)) // 2
    extremes = [reduce.reduceat(data.values, bounds, axis=1) for reduce in (np.fmin, np.fmax)]
    times = np.stack([data.times[bounds], data.times[middles]], axis=1).ravel()
    times[-1] = data.times[-1]
    return PlotData(data.lines, times, np.stack(extremes, axis=2).reshape(len(data.values), -1))


def _compared(label: str, joint: str, motions: Sequence[Motion], factor: float = 1.0) -> PlotData:
    """Return the angle of one joint in each motion that has it, NaN before and after the motion."""
    known = [motion for motion in motions if joint in motion.joints.names]
    columns = [(m.joints.times, m.joints.values[:, m.joints.names.index(joint)]) for m in known]
    times = columns[0][0] if len(columns) == 1 else np.unique(np.concatenate([own for own, _ in columns]))
    values = np.degrees([factor * _within(times, own, column) for own, column in columns])
    return PlotData(tuple(Line(motion.label or label, motion.colour) for motion in known), times, values)


def _within(times: Array, known: Array, values: Array) -> Array:
    """Return values interpolated at ``times`` [s], NaN outside the ``known`` times [s]."""
    interpolated: Array = np.interp(times, known, values, left=np.nan, right=np.nan)
    return interpolated
