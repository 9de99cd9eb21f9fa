"""The answer in machine-readable form."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from continuum.discovery.decision import Kind
from continuum.discovery.result import Cause, Detectable, Diagnosis, Experiment, HandTest, Share, is_named
from continuum.identification.estimate import Estimate
from continuum.identification.nrmse import nrmse
from continuum.whole_file import write_whole


def write_json(result: Diagnosis, path: str | Path, made: Mapping[str, object]) -> None:
    """Write the answer.

    Args:
        result: the answer.
        path: file to write.
        made: how it was made: inputs, version, seed.

    Raises:
        FileError: the file cannot be written.
    """
    write_whole(path, json.dumps(as_mapping(result) | {"made": dict(made)}, indent=2) + "\n")


def as_mapping(result: Diagnosis) -> dict[str, Any]:
    """Return the answer as numbers, strings, lists and mappings; joints count from 1, units are SI."""
    verdict = result.verdict
    effects = [[_cause(cause) for cause in causes] for causes in result.sets]
    relative_fits = verdict.relative_fits if is_named(verdict.kind) else (1.0,) * len(effects)
    sets = [{"relative_fit": p, "effects": one} for one, p in zip(effects, relative_fits, strict=True)]
    named = is_named(verdict.kind)
    return {
        "verdict": verdict.kind.value,
        "complete": bool(verdict.complete),
        "steady": bool(verdict.steady) if named else None,
        "sets": sets if named else [],
        "causes": effects[0] if named and effects else [],
        "alternatives": [cause for one in effects[1:] for cause in one] if named else [],
        "helps": [_cause(cause) for cause in result.causes] if verdict.kind is Kind.UNKNOWN else [],
        "shares": {name: _share(share) for name, share in result.shares.items()},
        "closed": _share(result.closed),
        "missing_torque": {"unit": "N m", "before": _list(result.sigma[0]), "after": _list(result.sigma[1])},
        "open_loop": {
            "unit": "rad",
            "noise": result.before.floor,
            "tolerance": result.tolerance,
            "runs": {run.name: _run(result, r) for r, run in enumerate(result.recordings)},
        },
        "parameters": [_estimate(one) for one in result.estimates],
        "power": [_detectable(one) for one in result.power],
        "experiments": [_experiment(one) for one in result.experiments],
        "measurements_by_hand": [_hand_test(one) for one in result.hand_tests],
        "removals": [{"effect": one.effect, "instruction": one.instruction} for one in result.removals],
        "measured": list(result.measured),
        "zeroed": list(result.zeroed),
        "notes": list(result.notes),
        "processor_seconds": result.seconds,
    }


def _run(result: Diagnosis, r: int) -> dict[str, Any]:
    theta = result.recordings[r].theta
    return {
        when: {"rms": _number(one.error(r, theta)), "nrmse": _number(nrmse(one.angles[r], theta))}
        for when, one in (("before", result.before), ("after", result.after))
    }


def _cause(cause: Cause) -> dict[str, Any]:
    joints = None if cause.joints is None else [joint + 1 for joint in cause.joints]
    return {
        "effect": cause.effect,
        "joint": joints[0] if joints is not None and len(joints) == 1 else None,
        "joints": joints,
        "share": _share(cause.share),
        "log_evidence": cause.gain,
        "parameters": [_estimate(one) for one in cause.estimates],
    }


def _estimate(one: Estimate) -> dict[str, Any]:
    return {
        "name": one.name,
        "joint": None if one.joint is None else one.joint + 1,
        "recording": one.recording or None,
        "value": one.value,
        "low": _number(one.low),
        "high": _number(one.high),
        "unit": one.unit,
    }


def _detectable(one: Detectable) -> dict[str, Any]:
    joints = None if one.joints is None else [joint + 1 for joint in one.joints]
    return {
        "effect": one.effect,
        "joints": joints,
        "parameter": one.parameter,
        "smallest": _number(one.smallest),
        "typical": one.typical,
        "unit": one.unit,
        "shown": one.is_shown,
        "reason": one.reason,
    }


def _experiment(one: Experiment) -> dict[str, Any]:
    return {
        "name": one.name,
        "instruction": one.instruction,
        "separates": _number(one.separates),
        "runs": one.runs or None,
        "shows": list(one.shows),
    }


def _hand_test(one: HandTest) -> dict[str, Any]:
    return {
        "name": one.name,
        "unit": one.unit,
        "sd": one.sd,
        "apart": _number(one.apart),
        "decides": one.decides,
        "instruction": one.instruction,
    }


def _share(share: Share) -> dict[str, Any]:
    return {"value": _number(share.value), "low": _number(share.low), "high": _number(share.high)}


def _list(values: Sequence[float] | np.ndarray) -> list[float | None]:
    return [_number(float(value)) for value in values]


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
