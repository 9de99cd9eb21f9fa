"""Results made by hand, whose figures are known."""

from __future__ import annotations

from typing import Any

from blind.mujoco_plant import EFFECTS

from tools.benchmarks.discovery.plans import Plan, campaign
from tools.benchmarks.discovery.result import Result

SEEDS = {half: next(campaign(half, 1)).seed for half in ("development", "held-out")}


def effect(name: str, joint: int | None = None, amount: float = 0.1) -> dict[str, Any]:
    """A hidden one, as the plants tell it."""
    kind = EFFECTS[name]
    return {"name": name, "joint": joint, "amount": amount, "unit": kind.unit, "in_a_library": kind.in_a_library}


def named(name: str, *joints: int, **values: tuple[float, float, float]) -> dict[str, Any]:
    """A cause at some joints; ``values`` are value and interval by parameter."""
    parameters = [
        {
            "name": f"{name}.{parameter}", "joint": joints[0] if len(joints) == 1 else None, "recording": None,
            "value": value, "low": low, "high": high, "unit": "1",
        }
        for parameter, (value, low, high) in values.items()
    ]  # fmt: skip
    share = {"value": 0.95, "low": 0.9, "high": 1.0}
    return {
        "effect": name, "joint": joints[0] if len(joints) == 1 else None, "joints": list(joints) or None,
        "share": share, "log_evidence": 20.0, "parameters": parameters,
    }  # fmt: skip


def verdict(
    kind: str, *sets: list[dict[str, Any]], p: tuple[float, ...] = (), complete: bool = True, closed: float = 0.95
) -> dict[str, Any]:
    """One as the JSON has it."""
    stated = p or (1 / len(sets),) * len(sets) if sets else ()
    run = {"before": {"rms": 0.02, "nrmse": 0.1}, "after": {"rms": 0.004, "nrmse": 0.02}}
    return {
        "verdict": kind,
        "complete": complete,
        "sets": [{"relative_fit": one, "effects": effects} for one, effects in zip(stated, sets, strict=True)],
        "helps": [],
        "shares": {"unknown": {"value": 0.05, "low": 0.0, "high": 0.1}},
        "closed": {"value": closed, "low": 0.9, "high": 1.0},
        "open_loop": {"unit": "rad", "noise": 0.003, "tolerance": 0.01, "runs": {"run_1": run}},
    }


def result(
    hidden: list[dict[str, Any]],
    answer: dict[str, Any] | None,
    size: str = "medium",
    half: str = "development",
    number: int = 0,
    seconds: float = 6.0,
) -> Result:
    names = tuple(one["name"] for one in hidden)
    plan = Plan("moreau", names, size, "mixed", 8, "ordinary", SEEDS[half] + number)
    failure = "" if answer is not None else "Traceback\nValueError: no | verdict"
    return Result("0123456789ab", plan, hidden, answer, failure, seconds, 500.0)
