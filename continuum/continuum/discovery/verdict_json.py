"""Findings for machines."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from continuum.discovery.candidate import Addition
from continuum.discovery.findings import Estimate, Findings
from continuum.discovery.motion_phases import PHASES, errors_by_phase
from continuum.discovery.verdict import Cause, Kind
from continuum.whole_file import write_whole


def write_json(found: Findings, path: str | Path, made: Mapping[str, object]) -> None:
    """Write the findings.

    Args:
        found: what to tell.
        path: where.
        made: how the diagnosis was made: what it read, version, seed.

    Raises:
        FileError: the file cannot be written.
    """
    write_whole(path, json.dumps(as_mapping(found) | {"made": dict(made)}, indent=2) + "\n")


def as_mapping(found: Findings) -> dict[str, Any]:
    """Numbers, strings, lists and mappings; joints count from 1, units are SI."""
    verdict, unknown = found.verdict, found.verdict.kind is Kind.UNKNOWN
    causes = [_cause(cause, found.estimates) for cause in verdict.causes]
    return {
        "verdict": verdict.kind.value,
        "causes": [] if unknown else causes,
        "helps": causes if unknown else [],
        "alternatives": [_cause(cause, own) for cause, own in zip(verdict.alternatives, found.others, strict=True)],
        "experiment": verdict.experiment,
        "unexplained": {"before": verdict.unexplained[0], "after": verdict.unexplained[1]},
        "nrmse_position": _scores(found, "position"),
        "nrmse_velocity": _scores(found, "rate"),
        "gap_closed": found.closed,
        "best_other": _other(found),
        "errors_by_phase": {"unit": "rad", **_by_phase(found)},
        "parameters": [{"name": str(e.unknown), **_estimate(e)} for e in found.estimates],
        "identifiability": {
            "unknowns": len(found.identifiability.unknowns),
            "rank": found.identifiability.rank,
            "condition": _number(found.identifiability.condition),
            "entangled": [[str(a), str(b), r] for a, b, r in found.identifiability.entangled],
            "untold": [str(unknown) for unknown in found.identifiability.untold],
        },
        "complete": not unknown and verdict.to_close is None,
        "at_odds": verdict.at_odds,
        "vague": verdict.vague,
        "weakness": found.weakness,
        "notes": list(found.notes),
    }


def _cause(cause: Cause, estimates: Sequence[Estimate]) -> dict[str, Any]:
    joints = _joints(cause.addition)
    prefix = cause.addition.effect + "."
    return {
        "effect": cause.addition.effect,
        "joint": joints[0] if joints is not None and len(joints) == 1 else None,
        "joints": joints,
        "confidence": cause.confidence,
        "gain": cause.gain.log_likelihood,
        "information": cause.gain.information,
        "parameters": {
            str(e.unknown)[len(prefix) :]: _estimate(e) for e in estimates if e.unknown.name.startswith(prefix)
        },
    }


def _joints(addition: Addition) -> list[int] | None:
    """Where an effect acts, from 1; null where it belongs to no joints."""
    return None if addition.joints is None else [joint + 1 for joint in addition.joints]


def _other(found: Findings) -> dict[str, Any] | None:
    """What the best effect that is not named would close of the distance to the noise."""
    if found.other is None:
        return None
    at = found.other.addition
    return {"effect": at.effect, "joints": _joints(at), "gap_closed": found.other.closed}


def _estimate(e: Estimate) -> dict[str, Any]:
    return {"value": e.value, "low": e.low, "high": e.high, "unit": e.unit, "at_limit": e.at_limit}


def _scores(found: Findings, what: str) -> dict[str, dict[str, object]]:
    """By run, with 95 % intervals; null where a model could not be simulated."""
    told: dict[str, dict[str, object]] = {}
    for b, a in zip(found.before, found.after, strict=True):
        between = [getattr(score, f"{what}_interval") for score in (b, a)]
        told[b.name] = {
            "before": _number(getattr(b, what)),
            "after": _number(getattr(a, what)),
            "before_interval": [_number(end) for end in between[0]],
            "after_interval": [_number(end) for end in between[1]],
        }
    return told


def _by_phase(found: Findings) -> dict[str, dict[str, list[float | None]]]:
    """Error of free runs in every phase of motion, joint by joint; null where no joint was in it."""
    return {
        when: {phase: [_number(error) for error in of_joints] for phase, of_joints in zip(PHASES, errors, strict=True)}
        for when, errors in zip(("before", "after"), errors_by_phase(found.before, found.after), strict=True)
    }


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
