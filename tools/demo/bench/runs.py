"""The runs of the demo: tensions over time, and when all cables are released."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array


@dataclass(frozen=True)
class Run:
    """One recording.

    Attributes:
        name: of its folder.
        pull: tension of each cable [N] at a time since the run began [s].
        pulled: for how long it is pulled [s].
        released: all tension then drops at once; otherwise `pull` ends slack.
        after: for how long it is recorded further [s].
    """

    name: str
    pull: Callable[[float], Array]
    pulled: float
    released: bool
    after: float


def ramp(tension: float, cable: int, over: float) -> Callable[[float], Array]:
    """One cable pulled up to ``tension`` [N] within ``over`` [s], and held."""

    def pull(t: float) -> Array:
        tensions = np.zeros(2)
        tensions[cable - 1] = tension * min(t / over, 1.0)
        return tensions

    return pull


def profile(t: float) -> Array:
    """To and fro, ever further: each cable in its turn, by half a sine of 1.5 s; highest 18 N after 6 s."""
    swing = np.sin(np.pi * t / 1.5)
    highest = 6.0 + 12.0 * min(t / 6.0, 1.0)
    return highest * np.maximum([swing, -swing], 0.0)


RUNS = (
    Run("release_1", ramp(20.0, 1, 1.0), 1.5, True, 2.0),
    Run("release_2", ramp(16.0, 2, 1.0), 1.5, True, 2.0),
    Run("profile", profile, 6.0, False, 1.5),
)

BEND = Run("bend", lambda t: np.array([15.0 * np.sin(np.pi * min(t, 3.0) / 3.0) ** 2, 0.0]), 3.0, False, 1.5)
"""Towards cable 1 and back, which shows the sensors' axes."""
