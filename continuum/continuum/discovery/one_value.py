"""A trial whose values of all recordings are one and the same: where a fit may go on that got stuck before them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.discovery.trial import Trial


def with_one_value(trial: Trial) -> Trial:
    """The trial with the median of all recordings for each value that belongs to one."""
    coordinates = trial.coordinates.copy()
    own = [(i, unknown) for i, unknown in enumerate(trial.unknowns) if unknown.recording is not None]
    for value in {(unknown.name, unknown.joint) for _, unknown in own}:
        family = [i for i, unknown in own if (unknown.name, unknown.joint) == value]
        coordinates[family] = np.median(coordinates[family])
    return replace(trial, coordinates=coordinates)
