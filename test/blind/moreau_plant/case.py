"""Cases of this plant: angles without rates, from sensors that were never zeroed well."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from blind import mujoco_plant
from blind.moreau_plant.machine import STEPS, Machine
from blind.mujoco_plant import Case, Effect, Noise
from blind.mujoco_plant.case import draw_plan

ZEROING = np.radians(0.15)  # standard deviation of each joint's error of zero in a recording [rad]


def zeroed_badly(noise: Noise) -> Noise:
    """The same with errors of zero: a joint's is the difference of its two links'."""
    return replace(noise, start=float(np.hypot(noise.start, ZEROING / np.sqrt(2))))


NOISES = {name: zeroed_badly(noise) if name != "none" else noise for name, noise in mujoco_plant.NOISES.items()}


def make_case(
    effects: Sequence[str | Effect] = (),
    size: str | float = "medium",
    dataset: str | Sequence[str] = "mixed",
    seed: int = 0,
    noise: str | Noise = "ordinary",
    *,
    rates: bool = False,
    steps: int = STEPS,
    **given: Any,
) -> Case:
    """Measure an arm with given effects, as ``blind.mujoco_plant.make_case`` does with the same arguments.

    A seed draws the same arm, effects and commands as there. Noise by name comes with errors of zero, and files hold
    no rates.
    """
    return mujoco_plant.make_case(
        effects, size, dataset, seed, noise, rates=rates, steps=steps, machine=Machine, noises=NOISES, **given
    )


def draw_case(seed: int, kind: str | None = None, **given: Any) -> Case:
    """Measure what ``draw_plan`` hides, with the same arguments."""
    plan = draw_plan(seed, kind, **given)
    return make_case(plan.effects, plan.size, plan.dataset, plan.seed, plan.noise)
