"""Charts of the page of a diagnosis: measured and simulated angles, residuals, missing torque."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.discovery.fit_result import OpenLoop
from continuum.discovery.report.chart import Axes, Chart, Line, chart, shared
from continuum.discovery.result import Diagnosis
from continuum.identification.estimate import Z_95
from continuum.languages import ENGLISH, Message, Translator

BEFORE, AFTER, MEASURED = "before", "after", "measured"
"""Classes of the page's style sheet."""
TIME = Message("time [s]")
ANGLE = Message("angle [°]")
_RESIDUAL, _TORQUE = Message("residual [°]"), Message("missing torque [mN m]")
_FIRST = (400.0, 230.0)  # width and height [px]: two side by side on a screen, one below the other on a phone
SMALL = (320.0, 130.0)


class Place(NamedTuple):
    """A recording and a joint, from 0."""

    run: int
    joint: int


class JointCharts(NamedTuple):
    """Charts of one joint in one recording: angles, residuals, missing torque; all joints have the same scales."""

    angles: Chart
    residuals: Chart
    torques: Chart


def noise_band(result: Diagnosis) -> float:
    """Return the half-width of the band around zero that contains 95 % of the angles' noise [degrees]."""
    return Z_95 * float(np.degrees(result.before.floor))


def worst_place(result: Diagnosis) -> Place:
    """Return the joint that lacks most torque, in the recording that the refitted model simulates worst there."""
    joint = int(np.nanargmax(result.sigma[0]))
    errors = [_rms(result.before, result, r, joint) for r in range(len(result.recordings))]
    return Place(int(np.nanargmax(errors)) if np.any(np.isfinite(errors)) else 0, joint)


def first_charts(result: Diagnosis, tr: Translator) -> tuple[Chart, Chart]:
    """Return charts of measured and simulated angles and of the missing torque, both at the worst place."""
    place = worst_place(result)
    return chart(_angles(result, place, tr), *_FIRST), chart(_torques(result, place, tr), *_FIRST)


def charts_of_run(result: Diagnosis, run: int, tr: Translator = ENGLISH) -> list[JointCharts]:
    """Return the charts of all joints of a recording."""
    places = [Place(run, joint) for joint in range(result.recordings[run].n_joints)]
    kinds = ([kind(result, place, tr) for place in places] for kind in (_angles, _residuals, _torques))
    return [JointCharts(*(chart(one, *SMALL) for one in three)) for three in zip(*map(shared, kinds), strict=True)]


def torques_over_angle(result: Diagnosis, tr: Translator) -> list[Chart]:
    """Return charts of the missing torque of each joint over its angle, with all recordings."""
    n = result.n_joints
    axes = [Axes(title(j, _TORQUE, tr), tr(ANGLE), tuple(_over_angle(result, j))) for j in range(n)]
    return [chart(one, *SMALL) for one in shared(axes)]


def title(joint: int, what: Message, tr: Translator) -> str:
    """Return what is above the axes of a joint, from 0."""
    return tr("joint {joint}: {what}", joint=joint + 1, what=what)


def _over_angle(result: Diagnosis, joint: int) -> list[Line]:
    return [
        Line(style, np.degrees(run.theta[:, joint]), 1e3 * torque[:, joint])
        for style, courses in _courses(result)
        for run, torque in zip(result.recordings, courses, strict=True)
    ]


def _angles(result: Diagnosis, place: Place, tr: Translator) -> Axes:
    measured = result.recordings[place.run].theta
    curves = [(MEASURED, measured), *((style, loop.angles[place.run]) for style, loop in _loops(result))]
    return _over_time(result, place, ANGLE, tr, [(style, np.degrees(angle)) for style, angle in curves])


def _residuals(result: Diagnosis, place: Place, tr: Translator) -> Axes:
    """Return the axes of the residuals, simulated minus measured."""
    measured = result.recordings[place.run].theta
    curves = [(style, np.degrees(loop.angles[place.run] - measured)) for style, loop in _loops(result)]
    return _over_time(result, place, _RESIDUAL, tr, curves, noise_band(result))


def _torques(result: Diagnosis, place: Place, tr: Translator) -> Axes:
    curves = [(style, 1e3 * courses[place.run]) for style, courses in _courses(result)]
    return _over_time(result, place, _TORQUE, tr, curves)


def _over_time(
    result: Diagnosis,
    place: Place,
    what: Message,
    tr: Translator,
    curves: Sequence[tuple[str, Array]],
    band: float = 0.0,
) -> Axes:
    times = result.recordings[place.run].times
    lines = tuple(Line(style, times, values[:, place.joint]) for style, values in curves)
    return Axes(title(place.joint, what, tr), tr(TIME), lines, band, (float(times[0]), float(times[-1])))


def _loops(result: Diagnosis) -> list[tuple[str, OpenLoop]]:
    return [(BEFORE, result.before), *([(AFTER, result.after)] if result.is_extended else [])]


def _courses(result: Diagnosis) -> list[tuple[str, tuple[Array, ...]]]:
    before, after = result.missing
    return [(BEFORE, before), *([(AFTER, after)] if result.is_extended else [])]


def _rms(loop: OpenLoop, result: Diagnosis, run: int, joint: int) -> float:
    residual = loop.angles[run][:, joint] - result.recordings[run].theta[:, joint]
    return float(np.sqrt(np.mean(residual**2)))
