"""Hypotheses from the effect library: the columns of an effect, with a Gaussian prior on its coefficients.

A coefficient is one of three kinds. ``slot``: a value of the compiled model, or of a sensor, in which Eq. 12 is nearly
linear. ``value``: the whole torque of an effect with states at given values, 1 if these are right. ``log``: a relative
change of one of those values.
"""

from __future__ import annotations

import itertools
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.parameters import Parameter
from continuum.estimation.structure import absent_values

PRIOR = 3.0
"""Prior standard deviation of an effect's size in units of its typical one: effects that matter are typical or a few
times larger, and the evidence changes only by the logarithm of this number."""
GRID = (0.3, 1.0, 3.0)
"""Sizes, in units of the typical one, at which an effect with states is screened: close enough for a Gauss-Newton step
to lead from one to the next."""
ORDINARY = 0.5
"""Prior standard deviation of the coefficient of an effect with states at its ordinary size."""
FRICTION = "joint_friction"
"""Name of friction as an effect if a model file has none."""
TOLERANCE = 2.5
"""Standard deviations beyond which a part is not ordinary: one in eighty lies beyond."""


@dataclass(frozen=True)
class Coefficient:
    """The meaning of one coefficient of a hypothesis.

    Attributes:
        kind: slot, value or log.
        effect, parameter: effect and parameter that it belongs to.
        joints: joints that it belongs to, from 0; empty if none.
    """

    kind: str
    effect: str
    parameter: str
    joints: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """An effect at a place, as a linear map from a few coefficients to columns.

    Attributes:
        effect: name of the effect.
        joints: joints at which it acts, from 0; None if it acts on the whole arm.
        columns, weights: indices and factors of each coefficient's columns; factors of 1 if empty.
        coefficients: meaning of the coefficients.
        sd: their prior standard deviations, (k,).
        least: their lower bounds, (k,), minus infinity if there is none.
        local: columns with per-run coefficients.
        local_sd: their prior standard deviations.
        start: values at which the torque of an effect with states was evaluated.
    """

    effect: str
    joints: tuple[int, ...] | None
    columns: tuple[tuple[int, ...], ...]
    coefficients: tuple[Coefficient, ...]
    sd: Array
    least: Array
    local: tuple[int, ...] = ()
    local_sd: Array = field(default_factory=lambda: np.zeros(0))
    start: Mapping[str, Array] | None = None
    weights: tuple[tuple[float, ...], ...] = ()

    @property
    def key(self) -> tuple[str, tuple[int, ...] | None]:
        """Effect and place, regardless of values."""
        return self.effect, self.joints

    @property
    def is_refit(self) -> bool:
        """Whether its sizes are coordinates of the baseline, as `friction_of_all`."""
        return not self.columns and not self.local

    @property
    def label(self) -> str:
        """Label for tables, joints from 1."""
        return self.effect + ("@" + ",".join(str(j + 1) for j in self.joints) if self.joints is not None else "")

    def map(self, width: int) -> Array:
        """Return the matrix from coefficients to columns, (width, k)."""
        H = np.zeros((width, len(self.columns)))
        for k, used in enumerate(self.columns):
            H[list(used), k] = self.weights[k] if self.weights else 1.0
        return H


def friction_of_all(n: int) -> Hypothesis:
    """Return friction of an arm whose model file has none: its sizes are coordinates of the baseline at each joint."""
    return Hypothesis(FRICTION, tuple(range(n)), (), (), np.zeros(0), np.zeros(0))


def at_values(
    effect: Effect,
    joints: tuple[int, ...] | None,
    value: int,
    logs: Sequence[tuple[int, str, tuple[int, ...]]],
    start: Mapping[str, Array],
) -> Hypothesis:
    """Return an effect with states at given values: its whole torque, and relative changes of these values.

    Args:
        effect, joints: effect and joints.
        value: column of the torque.
        logs: columns of the relative changes, with parameter and joints.
        start: the values.
    """
    first = next(iter(effect.parameters))
    changes = (Coefficient("log", effect.name, which, where) for _, which, where in logs)
    return Hypothesis(
        effect.name, joints, ((value,), *((at,) for at, _, _ in logs)),
        (Coefficient("value", effect.name, first, joints or ()), *changes), np.ones(1 + len(logs)),
        np.array([0.0, *(-np.inf for _ in logs)]), start=dict(start),
    )  # fmt: skip


def not_measured(
    hypotheses: Sequence[Hypothesis], measured: Collection[tuple[str, str, int]], columns: Collection[int]
) -> list[Hypothesis]:
    """Return what measurements by hand leave open of hypotheses.

    Args:
        hypotheses: hypotheses of one library.
        measured: known values, by effect, parameter and joint, -1 if a value belongs to none.
        columns: columns of these values.
    """
    places, found = {(effect, joint) for effect, _, joint in measured}, list[Hypothesis]()
    for h in hypotheses:
        left = [k for k, used in enumerate(h.columns) if not set(columns) & set(used)]
        if h.start is not None and any((h.effect, joint) in places for joint in h.joints or (-1,)):
            continue
        if len(left) == len(h.columns):
            found.append(h)
        elif left:
            some = tuple(h.columns[k] for k in left), tuple(h.coefficients[k] for k in left)
            weights = tuple(h.weights[k] for k in left) if h.weights else ()
            found.append(
                replace(h, columns=some[0], coefficients=some[1], sd=h.sd[left], least=h.least[left], weights=weights)
            )
    return found


def sizes_and_shapes(effect: Effect) -> tuple[list[str], list[str]]:
    """Return the parameters in which an effect is linear and at 0 absent, and those that only give its shape."""
    shapes = [name for name, spec in effect.parameters.items() if spec.default or spec.shape]
    return [name for name in effect.parameters if name not in shapes], shapes


def shape_variants(effect: Effect, shapes: Sequence[str]) -> Iterator[dict[str, float]]:
    """Yield the shapes at their defaults, and all a typical amount above and below, within bounds."""
    seen = set()
    for step in (0.0, 1.0, -1.0):
        values = {}
        for name in shapes:
            spec = effect.parameters[name]
            value = (spec.default or 0.0) + step * (spec.typical or 0.0)
            values[name] = min(max(value, spec.lower), spec.upper)
        if (key := tuple(values.values())) not in seen:
            seen.add(key)
            yield values


def grid(effect: Effect, n: int) -> Iterator[dict[str, Array]]:
    """Yield the values at which an effect with states is screened: its ``beginnings``, or three sizes."""
    absent = absent_values(effect, n)
    if effect.beginnings:
        for begin in effect.beginnings:
            yield {**absent, **{name: np.full_like(absent[name], value) for name, value in begin.items()}}
        return
    first, spec = next(iter(effect.parameters.items()))
    for size in GRID:
        yield {**absent, first: np.full_like(absent[first], size * (spec.typical or 1.0))}


def fitted_parameters(effect: Effect) -> list[str]:
    """Return the fitted parameters of an effect with states: its size, and those in its ``beginnings``."""
    first = next(iter(effect.parameters))
    return list(dict.fromkeys([first, *itertools.chain.from_iterable(effect.beginnings)]))


def prior_sd(spec: Parameter) -> float:
    """Return the prior standard deviation of a size or a shape about its value without the effect."""
    return (1.0 if spec.default or spec.shape else PRIOR) * (spec.typical or 1.0)


def only(values: Array, j: int) -> Array:
    out = np.zeros_like(values)
    out[j] = values[j]
    return out


def within(spec: Parameter, values: Array) -> Array:
    return np.clip(values, spec.lower, spec.upper)
