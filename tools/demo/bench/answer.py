"""The effect that is hidden in the emulated arm, and what the diagnosis made of it, in the same words and units."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from continuum.discovery.words import estimate_in_words, estimate_name
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect, Model
from continuum.identification.estimate import Estimate

HIDDEN, JOINT, RATIO = "joint_friction", 2, 2.0
"""Effect hidden in the emulated arm: joint, from 1, and relative increase of its viscous and Coulomb friction."""


def with_hidden_effect(model: Model) -> Model:
    """Return the model with one joint that is too tight."""
    at_joint = RATIO * (np.arange(model.n_joints) == JOINT - 1)
    effect = ActiveEffect(effect_named(HIDDEN), dict.fromkeys(effect_named(HIDDEN).parameters, at_joint))
    return replace(model, effects=(*model.effects, effect))


def answer(verdict_file: Path) -> tuple[list[str], bool]:
    """Return truth and finding, one line each, and whether the diagnosis names the hidden effect and nothing else."""
    verdict = json.loads(verdict_file.read_text(encoding="utf-8"))
    causes = verdict["causes"]
    names = [(cause["effect"], cause["joint"]) for cause in causes]
    truth = [_in_words(name, JOINT, RATIO) for name in effect_named(HIDDEN).parameters]
    found = [_found_in_words(one) for cause in causes for one in cause["parameters"]]
    lines = [
        f"Hidden in the emulated arm was: {HIDDEN}@{JOINT}: {'; '.join(truth)}.",
        f"The diagnosis ({verdict['verdict']}) found, with 95 % intervals: {'; '.join(found) or 'nothing'}.",
    ]
    return lines, verdict["verdict"] == "cause" and names == [(HIDDEN, JOINT)]


def _found_in_words(one: Mapping[str, Any]) -> str:
    """Return an estimate of the verdict's file in words."""
    effect, _, name = one["name"].partition(".")
    low, high = (math.nan if one[end] is None else one[end] for end in ("low", "high"))
    return _in_words(name, one["joint"], one["value"], low, high, effect)


def _in_words(
    name: str, joint: int | None, value: float, low: float = math.nan, high: float = math.nan, effect: str = HIDDEN
) -> str:
    """Return a value of an effect by its name, with interval and unit, as a diagnosis prints it."""
    spec, index = effect_named(effect).parameters[name], None if joint is None else joint - 1
    one = Estimate(f"{effect}.{name}", index, "", value, low, high, spec.unit, spec.meaning)
    return f"{estimate_name(one)} {estimate_in_words(one)}"
