"""The runs of the demo: tensions over time and the release of all cables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array


@dataclass(frozen=True)
class Run:
    """One recording.

    Attributes:
        name: name of its folder.
        pull: function from the time since the start of the run [s] to the tension of each cable [N].
        pulled: duration of the pull [s].
        released: whether all tension then drops at once; otherwise `pull` ends slack.
        after: duration of the recording after the pull [s].
    """

    name: str
    pull: Callable[[float], Array]
    pulled: float
    released: bool
    after: float


def ramp(tension: float, cable: int, over: float) -> Callable[[float], Array]:
    """Return a pull of one cable that rises to ``tension`` [N] within ``over`` [s], and holds it."""

    def pull(t: float) -> Array:
        tensions = np.zeros(2)
        tensions[cable - 1] = tension * min(t / over, 1.0)
        return tensions

    return pull


def profile(t: float) -> Array:
    """Return alternating pulls of growing size: half sines of 1.5 s on each cable in turn, up to 18 N after 6 s."""
    swing = np.sin(np.pi * t / 1.5)
    highest = 6.0 + 12.0 * min(t / 6.0, 1.0)
    return highest * np.maximum([swing, -swing], 0.0)


RUNS = (
    Run("release_1", ramp(20.0, 1, 1.0), 1.5, True, 2.0),
    Run("release_2", ramp(16.0, 2, 1.0), 1.5, True, 2.0),
    Run("profile", profile, 6.0, False, 1.5),
)

BEND = Run("bend", lambda t: np.array([15.0 * np.sin(np.pi * min(t, 3.0) / 3.0) ** 2, 0.0]), 3.0, False, 1.5)
"""Bend towards cable 1 and back, which determines the sensors' axes."""
