"""What all trials of a diagnosis share."""

from __future__ import annotations

from dataclasses import dataclass

from continuum.dynamics.model import Model
from continuum.identification.free import Free
from continuum.identification.noise import Noise
from continuum.recordings.recording import Recording


@dataclass(frozen=True)
class Question:
    """Data, and the model that shall explain them.

    Attributes:
        model: with nominal values.
        baseline: unknowns that are fitted in any case.
        recordings: all runs.
        noise: of the sensors.
    """

    model: Model
    baseline: tuple[Free, ...]
    recordings: tuple[Recording, ...]
    noise: Noise
