"""Which parameters a fit may change: of all joints or of one, common to all recordings or of a single one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.values import parameter_slots, parameter_vector
from continuum.errors import InvalidValueError

THESIS_PARAMETERS = ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "stribeck_speed")
"""What the thesis identified (chapter 3.3), each common to all joints."""

_BASELINE_SD = 1.0  # prior standard deviation of a parameter of Eq. 12, in units of its nominal value
_EFFECT_SD = 3.0  # of an effect's parameter, in units of its typical size
_BATCH_ENDS = 2.5  # standard deviations, beyond which a part is not of the batch


@dataclass(frozen=True)
class Free:
    """One unknown.

    Attributes:
        name: name of the parameter, as in `Model.values`.
        joint: the only joint whose value changes, from 0; None changes those of all joints by the same amount.
        recording: the only recording in which the value changes, from 0; None changes it in all.
        tolerance: prior standard deviation relative to the model's value, if parts are known to be alike; None is wide.
    """

    name: str
    joint: int | None = None
    recording: int | None = None
    tolerance: float | None = None

    def __str__(self) -> str:
        where = "" if self.joint is None else f"[{self.joint + 1}]"
        return self.name + where + ("" if self.recording is None else f" of run {self.recording + 1}")


class FreeSpace:
    """Unknowns as coordinates around a model's values: values = origin + directions (scale * coordinates).

    Args:
        model: model whose values are the origin.
        unknowns: what may change.

    Attributes:
        origin: all values of the model, (n_p,).
        directions: their change per unit of each coordinate, (n_p, n_free).
        scale: one unit of each coordinate in the parameter's unit, (n_free,).
        lower, upper: bounds of the coordinates, (n_free,).
        prior_sd: prior standard deviation of the coordinates around 0, (n_free,).

    Raises:
        InvalidValueError: a parameter that the model does not have, or a joint that it does not have.
    """

    def __init__(self, model: Model, unknowns: Sequence[Free]) -> None:
        slots, meanings = parameter_slots(model), model.meanings()
        self.unknowns = tuple(unknowns)
        self.origin = parameter_vector(model)
        bounds = [
            (meanings[name].lower, meanings[name].upper) for name, slot in slots.items() for _ in self.origin[slot]
        ]
        self._allowed = np.array(bounds).T
        k = len(self.unknowns)
        self.directions, self.scale = np.zeros((self.origin.size, k)), np.zeros(k)
        self.lower, self.upper, self.prior_sd = np.zeros(k), np.zeros(k), np.zeros(k)
        for i, unknown in enumerate(self.unknowns):
            if unknown.name not in slots:
                raise InvalidValueError("free parameter", unknown.name, "one of " + ", ".join(slots))
            meaning, slot = meanings[unknown.name], slots[unknown.name]
            at = np.arange(slot.start, slot.stop)
            if unknown.joint is not None:
                if not 0 <= unknown.joint < at.size:
                    raise InvalidValueError(f"joint of {unknown.name}", unknown.joint + 1, f"1 to {at.size}")
                at = at[unknown.joint : unknown.joint + 1]
            values = self.origin[at]
            size = float(np.max(np.abs(values)))
            self.scale[i] = meaning.typical or size or 1e-3 * (meaning.upper - meaning.lower)
            self.prior_sd[i] = _BASELINE_SD if meaning.typical is None else _EFFECT_SD
            if unknown.tolerance is not None:
                self.scale[i], self.prior_sd[i] = unknown.tolerance * size, 1.0
            self.directions[at, i] = self.scale[i]
            if self.scale[i] == 0:  # absent parts are all alike
                continue
            self.lower[i] = (meaning.lower - values.min()) / self.scale[i]
            self.upper[i] = (meaning.upper - values.max()) / self.scale[i]
            if unknown.tolerance is not None:  # parts that differ by more are not of one batch
                self.lower[i], self.upper[i] = max(self.lower[i], -_BATCH_ENDS), min(self.upper[i], _BATCH_ENDS)

    def directions_of(self, recording: int) -> Array:
        """Return the directions in one recording, (n_p, n_free): unknowns of another recording change nothing."""
        found = np.zeros_like(self.directions)
        mine = self.affected_by(recording)
        found[:, mine] = self.directions[:, mine]
        return found

    def affected_by(self, recording: int) -> NDArray[np.intp]:
        """Return the numbers of the unknowns that do not belong to another recording."""
        return np.flatnonzero([unknown.recording in (None, recording) for unknown in self.unknowns])

    def common_values(self, coordinates: Array) -> Array:
        """Return all values of the model, (n_p,), at coordinates (n_free,), without unknowns of single recordings."""
        return self.values_of(-1, coordinates)

    def values_of(self, recording: int, coordinates: Array) -> Array:
        """Return all values of the model in one recording, (n_p,), at coordinates (n_free,).

        Sums of changes at all joints and at one are clipped to the bounds of the parameter.
        """
        return np.asarray(np.clip(self.origin + self.directions_of(recording) @ coordinates, *self._allowed))

    def clipped(self, coordinates: Array) -> Array:
        """Return coordinates clipped to the bounds."""
        return np.asarray(np.clip(coordinates, self.lower, self.upper))

    def amounts(self, coordinates: Array) -> Array:
        """Return what was added to each unknown's parameter, in the parameter's unit, (n_free,)."""
        return self.scale * coordinates
