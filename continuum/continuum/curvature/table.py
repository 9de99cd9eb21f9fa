"""The answer as tables for other programs: CSV, and JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.curvature.answer import Answer
from continuum.curvature.comparison import Comparison, Distance
from continuum.curvature.holds import Hold
from continuum.whole_file import write_table, write_whole

_COLUMNS = (
    "recording", "hold", "begin_s", "end_s", "joint", "measured_deg", "low_deg", "high_deg", "constant_deg",
    "dynamic_deg", "friction_low_deg", "friction_high_deg",
)  # fmt: skip


def write_csv(answer: Answer, path: str | Path) -> None:
    """Write a row for each joint of each hold, with angles in degrees and 2.5 and 97.5 % quantiles.

    Raises:
        FileError: the file cannot be written.
    """
    write_table(path, [_COLUMNS, *_rows(answer)])


def write_json(answer: Answer, path: str | Path, made: Mapping[str, object]) -> None:
    """Write everything; units are SI, joints and holds count from 1.

    Raises:
        FileError: the file cannot be written.
    """
    found = answer.overall
    whole = {
        "holds": [_hold(*one) for one in zip(answer.holds, answer.each, strict=True)],
        "overall": {
            "nearer": found.nearer.value,
            "closer_by": _distance(found.closer_by),
            "angles_to_constant": found.to_constant,
            "angles_to_dynamic": found.to_dynamic,
            "counts": {kind.value: count for kind, count in found.counts.items()},
        },
        "made": dict(made),
    }
    write_whole(path, json.dumps(whole, indent=2) + "\n")


def _rows(answer: Answer) -> Iterator[list[object]]:
    for number, (hold, one) in enumerate(zip(answer.holds, answer.each, strict=True), start=1):
        zone = one.held.zone
        angles = (one.theta, *one.quantiles, one.constant, one.held.theta, zone.lower, zone.upper)
        for joint, values in enumerate(np.degrees(np.stack(angles, axis=1)), start=1):
            begin, end = hold.times[[0, -1]]
            yield [
                hold.recording.name, number, round(begin, 6), round(end, 6), joint,
                *("" if math.isnan(value) else round(value, 4) for value in values.tolist()),
            ]  # fmt: skip


def _hold(hold: Hold, one: Comparison) -> dict[str, Any]:
    low, high = one.quantiles
    zone = one.held.zone
    return {
        "recording": hold.recording.name,
        "begin": float(hold.times[0]),
        "end": float(hold.times[-1]),
        "measured": {"median": _list(one.theta), "low": _list(low), "high": _list(high)},
        "constant_curvature": _list(one.constant),
        "dynamic_model": {
            "angles": _list(one.held.theta),
            "friction_low": _list(zone.lower),
            "friction_high": _list(zone.upper),
            "tension": _list(one.held.load.tension),
            "friction": one.held.friction,
        },
        "recorded_tension": None if hold.tension is None else _list(hold.tension),
        "bent_last": hold.approach,
        "angles_to_constant": _distance(one.angles_to_constant),
        "angles_to_dynamic": _distance(one.angles_to_dynamic),
        "tip_to_constant": _distance(one.tip_to_constant),
        "tip_to_dynamic": _distance(one.tip_to_dynamic),
        "nearer": one.nearer.value,
        "closer_by": _distance(one.closer_by),
        "beyond_friction": [int(joint) + 1 for joint in one.beyond_friction],
    }


def _distance(one: Distance) -> dict[str, float]:
    return {"value": one.value, "low": one.low, "high": one.high}


def _list(values: Array) -> list[float | None]:
    return [float(value) if math.isfinite(value) else None for value in values]
