"""Holds of simulated arms whose true joint angles are known, as `continuum curvature` finds them.

Each seed gives two recordings: one cable pulled to four tensions and held at each, and a release with a few rows before
it. Arm, tensions, durations and sensor noise are random; the noise is low, ordinary or high with probabilities of 1/4,
1/2 and 1/4, as in the hidden cases of test/blind.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from blind import moreau_plant, mujoco_plant
from blind.moreau_plant.machine import Machine as MoreauMachine
from blind.mujoco_plant.case import Builder
from blind.mujoco_plant.machine import RATE, Motion
from blind.mujoco_plant.parameters import JOINTS
from blind.mujoco_plant.regimes import RELEASE_ROWS
from blind.mujoco_plant.sensors import Noise, Reading

from continuum.arrays import Array
from continuum.curvature.answer import Answer, answer
from continuum.curvature.comparison import Comparison, compare
from continuum.curvature.holds import find_holds
from continuum.dynamics.model import Model
from continuum.dynamics.statics.resting_arm import RestingArm
from continuum.dynamics.tensions import Tensions
from continuum.recordings.recording import Recording

PLANTS: Mapping[str, tuple[Builder, Mapping[str, Noise], int]] = {
    "MuJoCo": (mujoco_plant.Machine, mujoco_plant.NOISES, mujoco_plant.machine.STEPS),
    "Moreau": (MoreauMachine, moreau_plant.case.NOISES, moreau_plant.machine.STEPS),
}
"""Plants: motion, sensors, and integrator steps per sample."""

_LEVELS = {"low": 0.25, "ordinary": 0.5, "high": 0.25}
_PULLS = 4
_RAMP, _HELD, _TENSION = (0.6, 1.5), (1.5, 2.5), (3.0, 26.0)  # [s], [s], [N]: what is drawn
_BEND, _ROWS = np.radians((45.0, 110.0)), (2, 9)  # of a release


@dataclass(frozen=True)
class KnownHold:
    """One hold.

    Attributes:
        level: level of the noise.
        released: whether the hold precedes a release.
        since: time from the start of the recording to the middle of the hold [s].
        found: result of the comparison.
        true: median of the true joint angles over the hold, (n,) [rad].
        truly: result of the comparison for the true angles.
    """

    level: str
    released: bool
    since: float
    found: Comparison
    true: Array
    truly: Comparison

    @property
    def inside(self) -> Array:
        """Whether the interval of each joint contains the true angle, (n,)."""
        low, high = self.found.quantiles
        return np.asarray((low <= self.true) & (self.true <= high))


def known_holds(name: str, model: Model, count: int) -> list[KnownHold]:
    """Return ``count`` holds of one of `PLANTS`, from seed 0 upwards, compared with ``model``."""
    found: list[KnownHold] = []
    seed = 0
    while len(found) < count:
        found += _of_seed(name, model, seed)
        seed += 1
    return found[:count]


def _of_seed(name: str, model: Model, seed: int) -> Iterator[KnownHold]:
    machine, noises, steps = PLANTS[name]
    drawing, moving, reading = np.random.default_rng([seed, 43]).spawn(3)
    p, level = mujoco_plant.varied(drawing), str(drawing.choice(list(_LEVELS), p=list(_LEVELS.values())))
    side, arm = int(drawing.choice([-1, 1])), RestingArm(model)
    command = _pulls(drawing, side)
    pulled = machine(p, (), moving, steps, len(command) / RATE)
    pulled.settle(command[0])
    held, bend = int(drawing.integers(*_ROWS)), side * drawing.uniform(*_BEND)
    let_go = machine(p, (), moving, steps, RELEASE_ROWS / RATE)
    before = np.zeros((RELEASE_ROWS, 2))
    before[:held] = let_go.pull_to(bend)
    motions = (pulled.record(command), command), (let_go.record(before, let_go_at=held), before)
    for released, (motion, tension) in enumerate(motions):
        recording, true = _recorded(f"{name} {seed}", motion, tension, noises[level], reading)
        holds = find_holds(recording)
        each: Answer | None = answer(model, holds) if holds else None
        for hold, one in zip(holds, each.each if each else (), strict=True):
            angles = np.median(true[hold.rows], axis=0)
            truly = compare(arm, angles, np.zeros((JOINTS, JOINTS)), hold.tension, hold.approach)
            yield KnownHold(level, bool(released), hold.since_begin, one, angles, truly)


def _pulls(rng: np.random.Generator, side: int) -> Array:
    """Tensions of both cables at each row, (rows, 2) [N]."""
    times, tensions = [0.0], [0.0]
    for _ in range(_PULLS):
        ramped = times[-1] + rng.uniform(*_RAMP)
        times += [ramped, ramped + rng.uniform(*_HELD)]
        tensions += [rng.uniform(*_TENSION)] * 2
    pull = np.interp(np.arange(int(times[-1] * RATE)) / RATE, times, tensions)
    return np.outer(pull, [side > 0, side < 0])


def _recorded(
    name: str, motion: Motion, tension: Array, noise: Noise, rng: np.random.Generator
) -> tuple[Recording, Array]:
    """Return the sensors' readings, and the true joint angles, (rows, 5) [rad]."""
    sensors = Reading(JOINTS, (), rng)
    true, _ = sensors.take(motion, Noise(), rng)
    angles, _ = sensors.take(motion, noise, rng)
    times = np.arange(motion.rows) / RATE
    return Recording(name, times, angles, None, Tensions(times, tension)), true
