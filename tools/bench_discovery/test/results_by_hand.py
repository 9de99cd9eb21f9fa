"""Results made by hand, whose figures are known."""

from __future__ import annotations

from typing import Any

from blind.plant import EFFECTS, Plan

from tools.bench_discovery.result import Result


def named(
    effect: str, joint: int | None = None, confidence: float = 0.9, **values: tuple[float, float, float]
) -> dict[str, Any]:
    """A cause; ``values`` are value and interval by parameter."""
    where = "" if joint is None else f"[{joint}]"
    parameters = {
        name + where: {"value": value, "low": low, "high": high, "unit": ""}
        for name, (value, low, high) in values.items()
    }
    joints = None if joint is None else [joint]
    return {"effect": effect, "joint": joint, "joints": joints, "confidence": confidence, "parameters": parameters}


def verdict(
    kind: str,
    *causes: dict[str, Any],
    others: tuple[dict[str, Any], ...] = (),
    closed: float = 0.5,
    after: float | None = 0.4,
) -> dict[str, Any]:
    scores = {"run_1": {"before": 0.4, "after": after}}
    return {
        "verdict": kind,
        "causes": list(causes),
        "helps": [],
        "alternatives": list(others),
        "gap_closed": closed,
        "nrmse_position": scores,
        "nrmse_velocity": scores,
    }


def effect(name: str, joint: int | None = None, amount: float = 0.1) -> dict[str, Any]:
    """A hidden one, as the plant tells it."""
    kind = EFFECTS[name]
    return {"name": name, "joint": joint, "amount": amount, "unit": kind.unit, "in_a_library": kind.in_a_library}


def result(
    hidden: list[dict[str, Any]],
    answer: dict[str, Any] | None,
    size: str = "medium",
    dataset: str = "releases",
    seed: int = 0,
    seconds: float = 60.0,
) -> Result:
    plan = Plan(tuple(one["name"] for one in hidden), size, dataset, seed, "ordinary")
    failure = "" if answer is not None else "no verdict within 1 s"
    return Result("0123456789ab", plan, {"effects": hidden}, answer, failure, seconds, 2 * seconds)
