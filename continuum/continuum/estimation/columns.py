"""Columns: torque, or change of a reading, per unit of each coefficient that a hypothesis may use.

All torques come from Eq. 12 with the library's effects along the smoothed motion: derivatives if an effect is linear in
its size, and the effect's whole torque at a given size if it has states or is nonlinear.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from continuum.arrays import Array
from continuum.estimation.compiled_loops import entry_point
from continuum.estimation.effect_states import SubstepMotion
from continuum.estimation.motion_equations import evaluate, packed, torques
from continuum.estimation.run import Run, Trajectory
from continuum.estimation.structure import Point, Structure

_DIFFERENCE = 1e-5  # step of a sensor's parameter: readings are linear in most of them


@dataclass(frozen=True)
class Scene:
    """Where columns are evaluated: one run, its trajectory, and the point of linearisation.

    Attributes:
        structure: structure of the model.
        point: point of linearisation.
        number: number of the run.
        run, way, along: rows, trajectory at the rows, and motion between them.
        sign: sign of the slip in each interval, (n_times - 1, n).
        cache: torques that several columns need.
    """

    structure: Structure
    point: Point
    number: int
    run: Run
    way: Trajectory
    along: SubstepMotion
    sign: Array
    cache: dict[object, Array] = field(default_factory=dict)

    def values(self) -> Array:
        """Return the values of the compiled model in this run, (n_p,)."""
        return self.point.values_in(self.structure, self.number)

    def by_parameters(self, changed: Mapping[str, Array] | None = None) -> Array:
        """Return the joint torques per unit of every parameter, (rows, n_p, n), after changing some values."""
        key = ("by_parameters", *((name, value.tobytes()) for name, value in (changed or {}).items()))
        if key not in self.cache:
            values, s = self.values(), self.structure
            for name, value in (changed or {}).items():
                values[s.slots[name]] = value
            rows = packed(self.along.motion, self.along.u, self.along.slip, values)
            out = evaluate(s.equations.by_parameters, rows, s.n * (1 + s.equations.n_p))
            self.cache[key] = -out[:, s.n :].reshape(len(rows), s.equations.n_p, s.n)
        return self.cache[key]

    def nominal(self) -> Array:
        """Return the torque missing in Eq. 12 at the point's values, (rows, n) [N m]."""
        if "nominal" not in self.cache:
            self.cache["nominal"] = self.torque(self.values())
        return self.cache["nominal"]

    def torque(self, values: Array, u: Array | None = None) -> Array:
        """Return the torque missing in Eq. 12 at other values, or under other inputs, (rows, n) [N m]."""
        rows = packed(self.along.motion, self.along.u if u is None else u, self.along.slip, values)
        return torques(self.structure.equations, rows, self.structure.n)


class Column(Protocol):
    """One or several columns of torque, or of readings."""

    @property
    def width(self) -> int:
        """Number of columns."""

    def torque(self, scene: Scene) -> Array | None:
        """Return the torque, (rows, n, width) [N m per unit]; None if it changes only readings."""

    def reading(self, scene: Scene) -> Array | None:
        """Return the change of readings, (n_times, n_readings, width); None if it changes only torque."""


@dataclass(frozen=True)
class Sensitivity:
    """Derivative of Eq. 12 along directions in its parameters.

    Attributes:
        directions: directions in the parameters, (n_p, width).
        changed: parameter values at which it is taken, if other than those of the point.
    """

    directions: Array
    changed: Mapping[str, Array] = field(default_factory=dict)

    @property
    def width(self) -> int:
        return int(self.directions.shape[1])

    def torque(self, scene: Scene) -> Array | None:
        by_p = scene.by_parameters(self.changed)
        used = np.flatnonzero(np.any(self.directions != 0, axis=1))
        return np.asarray(np.einsum("rpn,pk->rnk", by_p[:, used], self.directions[used], optimize=True))

    def reading(self, scene: Scene) -> Array | None:  # noqa: ARG002
        return None


@dataclass(frozen=True)
class Change:
    """Torque at other values of some parameters minus that at the point's, one column.

    Attributes:
        factors: factors of the values, by parameter.
    """

    factors: Mapping[str, float]
    width: int = 1

    def torque(self, scene: Scene) -> Array | None:
        there = scene.values()
        for name, factor in self.factors.items():
            there[scene.structure.slots[name]] *= factor
        return (scene.torque(there) - scene.nominal())[:, :, None]

    def reading(self, scene: Scene) -> Array | None:  # noqa: ARG002
        return None


@dataclass(frozen=True)
class StatefulTorque:
    """Whole torque of an effect with states at given values, split by joint if it acts at each joint separately.

    Attributes:
        effect: name of the effect.
        params: its values, (n,) or (1,) each.
        joints: joints with a separate column each; if empty, one column for all joints.
    """

    effect: str
    params: Mapping[str, Array]
    joints: tuple[int, ...] = ()

    @property
    def width(self) -> int:
        return max(len(self.joints), 1)

    def torque(self, scene: Scene) -> Array | None:
        added = stateful_torque(scene, self.effect, self.params)
        if not self.joints:
            return added[:, :, None]
        out = np.zeros((*added.shape, len(self.joints)))
        for k, j in enumerate(self.joints):
            out[:, j, k] = added[:, j]
        return out

    def reading(self, scene: Scene) -> Array | None:  # noqa: ARG002
        return None


def stateful_torque(scene: Scene, effect: str, params: Mapping[str, Array]) -> Array:
    """Return the torque that an effect with states adds along the scene's motion, (rows, n) [N m]."""
    key = (effect, *((name, value.tobytes()) for name, value in params.items()))
    if key not in scene.cache:
        scene.cache[key] = scene.structure.stateful[effect].torque(scene.along, scene.values(), params, scene.nominal())
    return scene.cache[key]


@dataclass(frozen=True)
class Difference:
    """Half the difference of two columns: the Gauss-Newton column of a parameter."""

    above: Column
    below: Column

    @property
    def width(self) -> int:
        return self.above.width

    def torque(self, scene: Scene) -> Array | None:
        above, below = self.above.torque(scene), self.below.torque(scene)
        return None if above is None or below is None else (above - below) / 2

    def reading(self, scene: Scene) -> Array | None:  # noqa: ARG002
        return None


@dataclass(frozen=True)
class LateInputs:
    """Torque of inputs delayed by a time [s] minus that of inputs in time, one column."""

    delay: float
    width: int = 1

    def torque(self, scene: Scene) -> Array | None:
        return late_torque(scene, self.delay)[:, :, None]

    def reading(self, scene: Scene) -> Array | None:  # noqa: ARG002
        return None


def late_torque(scene: Scene, delay: float) -> Array:
    """Return the torque of inputs delayed by ``delay`` [s] minus that of inputs in time, (rows, n) [N m]."""
    key = ("late", delay)
    if key not in scene.cache:
        late = scene.run.inputs_later(delay)
        scene.cache[key] = scene.torque(scene.values(), late) - scene.nominal()
    return scene.cache[key]


@dataclass(frozen=True)
class SensorSensitivity:
    """Derivative of the readings by one parameter of an effect on sensors, a column for each of its joints."""

    effect: str
    parameter: str
    size: int

    @property
    def width(self) -> int:
        return self.size

    def torque(self, scene: Scene) -> Array | None:  # noqa: ARG002
        return None

    def reading(self, scene: Scene) -> Array | None:
        params, s = scene.point.by_run[scene.number], scene.structure
        here = s.readings(scene.run, scene.way.q, scene.way.w, params)
        out = np.empty((*here.shape, self.size))
        for j in range(self.size):
            moved = {name: dict(values) for name, values in params.items()}
            moved[self.effect][self.parameter] = moved[self.effect][self.parameter].copy()
            moved[self.effect][self.parameter][j] += _DIFFERENCE
            out[:, :, j] = (s.readings(scene.run, scene.way.q, scene.way.w, moved) - here) / _DIFFERENCE
        return out


def assembled(columns: Sequence[Column], scene: Scene) -> tuple[Array, Array]:
    """Return all columns: torque in the substeps, (rows, n, P), and readings, (n_times, n_readings, P)."""
    P = sum(column.width for column in columns)
    torque = np.zeros((len(scene.along.length), scene.structure.n, P))
    reading = np.zeros((*scene.run.readings.shape, P))
    at = 0
    for column in columns:
        part = slice(at, at + column.width)
        if (added := column.torque(scene)) is not None:
            torque[:, :, part] = added
        if (read := column.reading(scene)) is not None:
            reading[:, :, part] = read
        at += column.width
    return torque, reading


@entry_point
def to_states(W: Array, torque: Array, first: Array) -> Array:
    """Convert torque in the substeps to the state at the interval's end, (n_times - 1, 2 n, P)."""
    out = np.zeros((first.size - 1, W.shape[1], torque.shape[2]))
    for k in range(first.size - 1):
        for r in range(first[k], first[k + 1]):
            out[k] += W[r] @ torque[r]
    return out
