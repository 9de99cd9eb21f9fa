"""Coordinates of the baseline: springs and friction common to all joints, of any size that the data support.

Reference values of friction come from the motion, not from the model file: a file whose friction is far off must not
change a diagnosis. If the file's values are plausible, their pattern over the joints is kept. A file without any
friction has no such pattern: each joint then has separate friction, which is a hypothesis, not a refit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.springs_and_friction import dry_friction
from continuum.dynamics.values import with_vector
from continuum.estimation.columns import Change, Column, Sensitivity
from continuum.estimation.motion_equations import evaluate, packed, torques
from continuum.estimation.run import Run
from continuum.estimation.structure import Structure

FRICTION = 0.08
"""Expected dry and viscous friction, as a fraction of the torque that moves the arm; prior standard deviations scale
with it."""
_SHAPES = (0.5, 2.45)  # factors of Stribeck's rate: other shapes of its curve are mixtures of these
_PRIOR = {"stiffness": 0.5, "viscous": 1.0, "coulomb": 0.6, "stribeck": 1.0, "speed": 0.5}
_SHAPE_PRIOR = 0.33
_FAR = 10.0  # factor from the expected value beyond which a model file's value is not trusted
_LEAST = 0.02  # fraction of its reference below which a mass, inertia or spring is not physical
_ALMOST_NONE = 1e-3  # least friction of a joint as a fraction of the mean, so that it can be a divisor
_NONE = 1e-6  # fraction of its reference that counts as no Coulomb friction: Stribeck's torque is a multiple of it
_SPEED = (-0.8, 4.0)  # least and largest relative change of Stribeck's rate: beyond, its curve is another term
_ROUNDING = 1e-6  # fraction of a torque below which a remainder is rounding error
_RATES = (0.0, 0.5, 1.0, 2.0, 9.0)  # multiples of Stribeck's rate at which dry friction must not be negative
PARAMETER = {
    "stiffness": "stiffness", "viscous": "viscous_friction", "coulomb": "coulomb_friction",
    "stribeck": "stribeck_gain", "speed": "stribeck_speed",
}  # fmt: skip
"""Which parameter each kind of coordinate changes."""
_FRICTION = ("viscous", "coulomb", "stribeck", "speed")  # coordinates of friction

type Coordinate = tuple[str, int]
"""Kind of value that it changes, and joint, from 0; -1 for all joints alike."""


@dataclass(frozen=True)
class Coordinates:
    """The coordinates of an arm.

    Attributes:
        structure: structure of the model.
        reference: parameter values at which all coordinates are zero, (n_p,).
        torque: root mean square torque of the arm [N m].
        steps: change of each kind's parameter per unit of its coordinate, (n,) each.
        lacks_friction: whether the model file has no dry friction at any joint.
    """

    structure: Structure
    reference: Array
    torque: float
    steps: Mapping[str, Array]
    lacks_friction: bool

    @cached_property
    def all(self) -> list[Coordinate]:
        """The coordinates that this arm has."""
        found = list[Coordinate]()
        for name in _PRIOR:
            if self._is_lacking(name):
                found += [(name, j) for j in range(self.structure.n)]
            elif np.any(self.steps[name] != 0):
                found.append((name, -1))
        return found

    @cached_property
    def without_friction(self) -> dict[Coordinate, float]:
        """Friction coordinates of an arm without friction if the model file has none; otherwise empty."""
        if not self.lacks_friction:
            return {}
        p, slots = self.reference, self.structure.slots
        rise = p[slots["coulomb_friction"]] * p[slots["stribeck_gain"]]
        now = {"viscous": p[slots["viscous_friction"]], "coulomb": p[slots["coulomb_friction"]], "stribeck": rise}
        return {
            (name, joint): -float(now[name][joint] / self.steps[name][joint]) if name in now else 0.0
            for name, joint in self.all
            if self._is_lacking(name)
        }

    def _is_lacking(self, name: str) -> bool:
        """Whether the model file has no friction of a kind at any joint."""
        if not self.lacks_friction or name not in _FRICTION:
            return False
        return name != "viscous" or not np.any(self.structure.values[self.structure.slots["viscous_friction"]])

    def prior_sd(self, shapes: bool = True) -> Array:
        """Return the prior standard deviations of the coordinates, and of the shapes of Stribeck's curve if asked."""
        return np.array([_PRIOR[name] for name, _ in self.all] + [_SHAPE_PRIOR] * len(_SHAPES) * shapes)

    def _step(self, one: Coordinate) -> Array:
        """Return the change per unit of a coordinate, (n,)."""
        name, joint = one
        return self.steps[name] * (np.arange(self.structure.n) == joint if joint >= 0 else 1.0)

    def values(self, theta: Mapping[Coordinate, float]) -> Array:
        """Return the parameter values at given coordinates, (n_p,)."""
        p, slots = self.reference.copy(), self.structure.slots
        change = {name: np.zeros(self.structure.n) for name in _PRIOR}
        for one, value in theta.items():
            change[one[0]] = change[one[0]] + value * self._step(one)
        p[slots["stiffness"]] += change["stiffness"]
        p[slots["viscous_friction"]] += change["viscous"]
        coulomb, gain = self.reference[slots["coulomb_friction"]], self.reference[slots["stribeck_gain"]]
        changed = np.maximum(coulomb + change["coulomb"], _NONE * self.steps["coulomb"])
        rise = np.maximum(coulomb * gain + change["stribeck"], 0.0)
        p[slots["coulomb_friction"]], p[slots["stribeck_gain"]] = changed, rise / changed
        p[slots["viscous_friction"]] = np.maximum(p[slots["viscous_friction"]], 0.0)
        p[slots["stribeck_speed"]] = self.reference[slots["stribeck_speed"]] * (1 + np.clip(change["speed"], *_SPEED))
        return p

    def bounds(self) -> list[tuple[float, float]]:
        """Return the bounds of each coordinate within which `values` is linear and physical."""
        slots, p = self.structure.slots, self.reference
        coulomb = p[slots["coulomb_friction"]]
        now = {
            "stiffness": p[slots["stiffness"]] * (1 - _LEAST), "viscous": p[slots["viscous_friction"]],
            "coulomb": coulomb - _LEAST * self.steps["coulomb"], "stribeck": coulomb * p[slots["stribeck_gain"]],
        }  # fmt: skip
        found = []
        for name, joint in self.all:
            if name not in now:
                found.append(_SPEED)
                continue
            moved = self.steps[name] > 0
            least = np.where(moved, -now[name] / np.where(moved, self.steps[name], 1.0), -np.inf)
            found.append((float(least[joint] if joint >= 0 else np.max(least)), np.inf))
        return found

    def columns(self, p: Array) -> list[tuple[Coordinate | str, Column]]:
        """Return the torque per unit of each coordinate at parameter values p, and of each shape, by name."""
        found: list[tuple[Coordinate | str, Column]] = [
            (one, Sensitivity(self._direction(one, p)[:, None])) for one in self.all
        ]
        return found + [(f"shape_{k}", Change({"stribeck_speed": factor})) for k, factor in enumerate(_SHAPES)]

    def _direction(self, one: Coordinate, p: Array) -> Array:
        slots, out, step = self.structure.slots, np.zeros(p.size), self._step(one)
        coulomb, gain = p[slots["coulomb_friction"]], p[slots["stribeck_gain"]]
        match one[0]:
            case "stiffness":
                out[slots["stiffness"]] = step
            case "viscous":
                out[slots["viscous_friction"]] = step
            case "coulomb":  # Stribeck's torque stays the same
                out[slots["coulomb_friction"]] = step
                out[slots["stribeck_gain"]] = -gain / coulomb * step
            case "stribeck":
                out[slots["stribeck_gain"]] = step / coulomb
            case _:
                out[slots["stribeck_speed"]] = step * self.reference[slots["stribeck_speed"]]
        return out

    @cached_property
    def covered(self) -> frozenset[str]:
        """Parameters whose equal change at all joints has the same torque as a combination of the coordinates."""
        s, random = self.structure, np.random.default_rng(0)
        rows = 8 * len(self.all)
        motion, u = random.normal(size=(rows, 3, s.n)), random.uniform(size=(rows, s.equations.n_inputs))
        given = packed(motion, u, motion[:, 1], self.reference)
        by_p = evaluate(s.equations.by_parameters, given, s.n * (1 + s.equations.n_p))[:, s.n :]
        by_p = by_p.reshape(rows, s.equations.n_p, s.n).transpose(0, 2, 1).reshape(-1, s.equations.n_p)
        coordinates = by_p @ np.column_stack([self._direction(one, self.reference) for one in self.all])
        found = []
        for name, slot in s.slots.items():
            alike = np.sum(by_p[:, slot], axis=1)
            left = alike - coordinates @ np.linalg.lstsq(coordinates, alike)[0]
            if np.linalg.norm(left) < _ROUNDING * np.linalg.norm(alike):
                found.append(name)
        return frozenset(found)

    @cached_property
    def _given(self) -> Parameters:
        """The reference values as changed by the model's effects."""
        return with_vector(self.structure.model, self.reference).changed_parameters

    def constraints(self, p: Array, columns: Sequence[Column], width: int) -> tuple[Array, Array]:
        """Return G and g of g + G dtheta >= 0 about p, which keeps masses, inertias, springs and friction positive."""
        here = self._physical(p)
        G, at = np.zeros((here.size, width)), 0
        for column in columns:
            if isinstance(column, Sensitivity) and not column.changed:
                for k in range(column.width):
                    step = 1e-6 * column.directions[:, k]
                    G[:, at + k] = (self._physical(p + step) - here) / 1e-6
            elif isinstance(column, Change):
                there = p.copy()
                for name, factor in column.factors.items():
                    there[self.structure.slots[name]] *= factor
                G[:, at] = self._physical(there, p) - here
            at += column.width
        return G, here

    def _physical(self, p: Array, rates_of: Array | None = None) -> Array:
        """Return the quantities that must not be negative, divided by their references."""
        changed, given = with_vector(self.structure.model, p).changed_parameters, self._given
        parts = [
            np.where(one > 0, two / np.where(one > 0, one, 1.0) - _LEAST, 1.0)
            for one, two in (
                (given.stiffness, changed.stiffness), (given.mass, changed.mass), (given.inertia, changed.inertia),
            )
        ]  # fmt: skip
        parts.append(changed.viscous_friction / self.steps["viscous"])
        speed = (p if rates_of is None else rates_of)[self.structure.slots["stribeck_speed"]]
        parts += [dry_friction(factor * speed, changed) / self.steps["coulomb"] for factor in _RATES]
        parts.append(changed.coulomb_friction * changed.stribeck_gain / self.steps["coulomb"])
        return np.concatenate([np.broadcast_to(part, (self.structure.n,)) for part in parts]).astype(float)


def coordinates(structure: Structure, runs: Sequence[Run]) -> Coordinates:
    """Return the coordinates of an arm, scaled by its recordings."""
    slots, n = structure.slots, structure.n
    frictionless = structure.values.copy()
    for name in ("viscous_friction", "coulomb_friction"):
        frictionless[slots[name]] = 0.0
    squares, rates = [], []
    for run in runs:
        way = run.first_guess()
        q, w = run.between(way)
        rows = packed(np.stack([q, w, np.zeros_like(q)], axis=1), run.inputs, w, frictionless)
        squares.append(np.mean(torques(structure.equations, rows, n) ** 2, axis=0))
        rates.append(np.mean(way.w**2, axis=0))
    torque = float(np.sqrt(np.median(np.mean(squares, axis=0))))
    rate = float(np.sqrt(np.median(np.mean(rates, axis=0))))
    p = structure.values.copy()
    lacks_friction = not np.any(p[slots["coulomb_friction"]])
    expected = FRICTION * torque
    steps = {
        "stiffness": p[slots["stiffness"]].copy(),
        "viscous": _reference(p, slots["viscous_friction"], expected / rate),
        "coulomb": _reference(p, slots["coulomb_friction"], expected),
        "speed": np.ones(n),
    }
    p[slots["stribeck_gain"]] = np.where(
        (p[slots["stribeck_gain"]] > 0.1) & (p[slots["stribeck_gain"]] < _FAR), p[slots["stribeck_gain"]], 0.7
    )
    steps["stribeck"] = steps["coulomb"].copy()  # both then reach zero at all joints at once
    return Coordinates(structure, p, torque, steps, lacks_friction)


def _reference(p: Array, slot: slice, expected: float) -> Array:
    """Make the values in p plausible; return the change per unit, with the same pattern over the joints."""
    mean = float(np.mean(p[slot]))
    if not expected / _FAR < mean < expected * _FAR:
        p[slot] = expected
    p[slot] = np.maximum(p[slot], _ALMOST_NONE * np.mean(p[slot]))
    pattern = p[slot] / np.mean(p[slot])
    return np.asarray(pattern * max(float(np.mean(p[slot])), expected))
