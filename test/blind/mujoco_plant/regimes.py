"""Motions: how a cable is let go, and how tensions are commanded."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from blind.mujoco_plant.effect import DRIVEN, RELEASE
from blind.mujoco_plant.machine import RATE, Machine, Motion

RELEASE_ROWS = 193  # 1.6 s
BENDS = (np.radians(45.0), np.radians(110.0))


@dataclass(frozen=True)
class Run:
    """One recording before the sensors: its motion and the commanded tensions [N] (rows, 2)."""

    regime: str
    motion: Motion
    command: np.ndarray


def duration(regime: str, seconds: float) -> float:
    """Length of a recording [s]; that of a release is fixed."""
    return (RELEASE_ROWS - 1) / RATE if regime == RELEASE else seconds


def release(machine: Machine, rng: np.random.Generator, side: int, hold: bool) -> Run:
    """Pulled to a bend by one cable, held, and let go: the cables' base ends are free from some row on."""
    bend, held = side * rng.uniform(*BENDS), int(rng.integers(2, 9))
    command = np.zeros((RELEASE_ROWS, 2))
    command[:held] = machine.pull_to(bend)
    return Run(RELEASE, machine.record(command, let_go_at=held, hold=hold), command)


def driven(machine: Machine, rng: np.random.Generator, regime: str, seconds: float, hold: bool) -> Run:
    """Tensions of one of COMMANDS, after the arm has settled under the first row's."""
    time = np.arange(round(seconds * RATE) + 1) / RATE
    command = np.maximum(COMMANDS[regime](time, rng), 0.0)
    machine.settle(command[0])
    return Run(regime, machine.record(command, hold=hold), command)


def floor(rng: np.random.Generator) -> float:
    """Tension that neither cable falls below [N]: mostly none."""
    return float(rng.choice([0.0, rng.uniform(2.0, 6.0)], p=[0.75, 0.25]))


def pair(difference: np.ndarray, least: float | np.ndarray) -> np.ndarray:
    """Tensions (n, 2) of two cables from a difference (n,), neither below ``least``."""
    return np.column_stack([np.maximum(difference, 0) + least, np.maximum(-difference, 0) + least])


def ramp(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """One slow cycle: out to one side, back, out to the other, back."""
    corners = rng.choice([-1, 1]) * np.array([0.0, rng.uniform(15, 26), 0.0, -rng.uniform(15, 26), 0.0])
    return pair(np.interp(time / time[-1], np.linspace(0, 1, 5), corners), floor(rng))


def multisine(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Six sines from 0.3 to 3.5 Hz."""
    frequency = np.geomspace(0.3, 3.5, 6) * rng.uniform(0.9, 1.1, 6)
    wave = np.sum(np.sin(2 * np.pi * np.outer(time, frequency) + rng.uniform(0, 2 * np.pi, 6)), axis=1)
    wave *= rng.uniform(14, 24) / np.abs(wave).max()
    return pair(wave * np.minimum(1, time / 0.2), floor(rng))


def steps(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A new difference of tensions every 0.35 to 0.8 s."""
    starts = np.cumsum(rng.uniform(0.35, 0.8, int(time[-1] / 0.35) + 1))
    levels = np.append(0.0, rng.uniform(6, 22, starts.size) * rng.choice([-1, 1], starts.size))
    return pair(levels[np.searchsorted(starts, time, side="right")], floor(rng))


def chirp(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A sine whose frequency grows from 0.4 to 5 Hz."""
    low, high = 0.4, 5.0
    phase = 2 * np.pi * low * time[-1] / np.log(high / low) * ((high / low) ** (time / time[-1]) - 1)
    return pair(rng.choice([-1, 1]) * rng.uniform(10, 18) * np.sin(phase), floor(rng))


def hold_and_release(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Pulled slowly, held, and commanded down at once; then the other side."""
    end, least = time[-1], floor(rng)
    side, height = rng.choice([-1, 1]), rng.uniform(16, 26, 2)
    knots = np.array([0.0, 0.25, 0.32, 0.32, 0.5, 0.75, 0.82, 0.82, 1.0]) * end
    values = side * np.array([0, height[0], height[0], 0, 0, -height[1], -height[1], 0, 0])
    return pair(np.interp(time, knots, values), least)


def reversals(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Back and forth at equal speed, ever less far."""
    peaks = rng.uniform(18, 26) * np.array([0, 1, -0.85, 0.65, -0.5, 0.35, -0.25, 0.15, 0]) * rng.choice([-1, 1])
    knots = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(peaks)))])
    return pair(np.interp(time, knots / knots[-1] * time[-1], peaks), floor(rng))


def cocontraction(time: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Both cables pull more and more while their difference swings."""
    least = np.interp(time / time[-1], [0, 0.5, 1], [2, rng.uniform(15, 30), 2])
    wave = rng.uniform(8, 14) * np.sin(2 * np.pi * rng.uniform(0.5, 0.9) * time + rng.choice([0.0, np.pi]))
    return pair(wave, least)


Command = Callable[[np.ndarray, np.random.Generator], np.ndarray]
COMMANDS: dict[str, Command] = {
    "ramp": ramp,
    "multisine": multisine,
    "steps": steps,
    "chirp": chirp,
    "hold_and_release": hold_and_release,
    "reversals": reversals,
    "cocontraction": cocontraction,
}
RICH = ("multisine", "hold_and_release", "steps", "reversals")

# what a dataset is made of
DATASETS: dict[str, tuple[str, ...]] = {
    "releases": (RELEASE,) * 4,
    "eight_releases": (RELEASE,) * 8,
    "mixed": (RELEASE, RELEASE, "multisine", "hold_and_release"),
    "driven": RICH,
    "slow": ("ramp", "reversals", "ramp", "cocontraction"),
    "fast": ("chirp", "steps", "multisine", "chirp"),
    **{name: (name,) * 4 for name in COMMANDS},
}


def kinds(dataset: str) -> frozenset[str]:
    """Which kinds of recordings a dataset has."""
    return frozenset(RELEASE if regime == RELEASE else DRIVEN for regime in DATASETS[dataset])
