"""Hypotheses: which columns an effect may use, with a Gaussian prior on its coefficients, made from the effect library.

A coefficient is one of three kinds. ``slot``: a value of the compiled model, or of a sensor, in which Eq. 12 is nearly
linear. ``value``: the whole torque of an effect with states at given values, 1 where these are right. ``log``: a
relative change of one of those values.
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
times that, and evidence changes by the logarithm of this number only."""
GRID = (0.3, 1.0, 3.0)
"""Sizes, in units of the typical one, at which an effect with states is screened: neighbours are alike enough for a
Gauss-Newton step to lead from one to the other."""
ORDINARY = 0.5
"""Prior standard deviation of the coefficient of an effect with states at its ordinary size."""
FRICTION = "joint_friction"
"""What friction is called where a model file has none."""
TOLERANCE = 2.5
"""Standard deviations beyond which a part is not an ordinary one: one in eighty is."""


@dataclass(frozen=True)
class Coefficient:
    """What one coefficient of a hypothesis means.

    Attributes:
        kind: slot, value or log.
        effect, parameter: whose.
        joints: at which, from 0; empty where it belongs to none.
    """

    kind: str
    effect: str
    parameter: str
    joints: tuple[int, ...] = ()


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """An effect at a place, as a linear map from a few coefficients to columns.

    Attributes:
        effect: by name.
        joints: at which it acts, from 0; None where it belongs to the whole arm.
        columns, weights: of each coefficient, indices and factors; all 1 without.
        coefficients: what they mean.
        sd: their prior standard deviations, (k,).
        least: their lower bounds, (k,), minus infinity where there is none.
        local: columns that each recording has a coefficient of its own for.
        local_sd: their prior standard deviations.
        start: values of an effect with states at which its torque was taken.
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
        """Effect and place, whatever its values."""
        return self.effect, self.joints

    @property
    def is_refit(self) -> bool:
        """Whether its sizes are coordinates of the baseline, as `friction_of_all`."""
        return not self.columns and not self.local

    @property
    def label(self) -> str:
        """For tables, joints from 1."""
        return self.effect + ("@" + ",".join(str(j + 1) for j in self.joints) if self.joints is not None else "")

    def map(self, width: int) -> Array:
        """(width, k): from coefficients to columns."""
        H = np.zeros((width, len(self.columns)))
        for k, used in enumerate(self.columns):
            H[list(used), k] = self.weights[k] if self.weights else 1.0
        return H


def friction_of_all(n: int) -> Hypothesis:
    """Friction of an arm whose model file has none: its sizes are coordinates of the baseline, at each joint."""
    return Hypothesis(FRICTION, tuple(range(n)), (), (), np.zeros(0), np.zeros(0))


def at_values(
    effect: Effect,
    joints: tuple[int, ...] | None,
    value: int,
    logs: Sequence[tuple[int, str, tuple[int, ...]]],
    start: Mapping[str, Array],
) -> Hypothesis:
    """An effect with states at given values: its whole torque, and relative changes of these values.

    Args:
        effect, joints: which, and where.
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
    """What measurements by hand leave open of hypotheses.

    Args:
        hypotheses: of one library.
        measured: values that are known, by effect, parameter and joint, -1 where it belongs to none.
        columns: of these values.
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
    """Parameters by which an effect is linear and absent at 0, and those that only say what it looks like."""
    shapes = [name for name, spec in effect.parameters.items() if spec.default or spec.shape]
    return [name for name in effect.parameters if name not in shapes], shapes


def shape_variants(effect: Effect, shapes: Sequence[str]) -> Iterator[dict[str, float]]:
    """Shapes at their defaults, and all a typical amount above and below where that is allowed."""
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
    """Values at which an effect with states is screened: its own beginnings, or three sizes."""
    absent = absent_values(effect, n)
    if effect.beginnings:
        for begin in effect.beginnings:
            yield {**absent, **{name: np.full_like(absent[name], value) for name, value in begin.items()}}
        return
    first, spec = next(iter(effect.parameters.items()))
    for size in GRID:
        yield {**absent, first: np.full_like(absent[first], size * (spec.typical or 1.0))}


def fitted_parameters(effect: Effect) -> list[str]:
    """Of an effect with states, those that are fitted: its size, and those of which it has beginnings."""
    first = next(iter(effect.parameters))
    return list(dict.fromkeys([first, *itertools.chain.from_iterable(effect.beginnings)]))


def prior_sd(spec: Parameter) -> float:
    """Standard deviation of a size, or of a shape, about its value where the effect is absent."""
    return (1.0 if spec.default or spec.shape else PRIOR) * (spec.typical or 1.0)


def only(values: Array, j: int) -> Array:
    out = np.zeros_like(values)
    out[j] = values[j]
    return out


def within(spec: Parameter, values: Array) -> Array:
    return np.clip(values, spec.lower, spec.upper)
