"""The columns and hypotheses of all effects about one point of linearisation."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from continuum.arrays import Array
from continuum.discovery.coordinates import Coordinate
from continuum.discovery.hypotheses import (
    GRID,
    ORDINARY,
    TOLERANCE,
    Coefficient,
    Hypothesis,
    at_values,
    fitted_parameters,
    friction_of_all,
    grid,
    not_measured,
    only,
    prior_sd,
    shape_variants,
    sizes_and_shapes,
    within,
)
from continuum.dynamics.effect import Effect
from continuum.estimation.columns import Column, Difference, LateInputs, Sensitivity, SensorSensitivity, StatefulTorque
from continuum.estimation.structure import Structure, absent_values, delay_of, overrides


class Library:
    """All columns and hypotheses about one point of linearisation.

    Args:
        structure: structure of the model.
        active: values of the effects in the model that have states or a fitted shape.
        ratio: factor by which these values are changed for finite differences.
        baseline: columns that all hypotheses share, by coordinate or name.
        covered: parameters whose equal change at all joints these columns include.
        live: effects that have hypotheses; all if None.
        lacks_friction: whether friction is a hypothesis, as `friction_of_all`.
        measured: standard deviations of values that were measured by hand. These are no hypotheses; their columns
            become ordinary differences with these standard deviations.
    """

    def __init__(
        self,
        structure: Structure,
        active: Mapping[str, Mapping[str, Array]],
        ratio: float,
        baseline: Sequence[tuple[Coordinate | str, Column]],
        covered: Collection[str],
        live: Collection[str] | None = None,
        lacks_friction: bool = False,
        measured: Mapping[tuple[str, str, int], float] | None = None,
    ) -> None:
        self._measured = measured or {}
        self.structure, self.active, self.ratio = structure, active, ratio
        self.columns, self.width, self.hypotheses = list[Column](), 0, list[Hypothesis]()
        self.at: dict[tuple[str, str, int], int] = {}  # columns of values, by effect, parameter and joint
        self.torque_only: dict[str, int] = {}  # columns of torque without a value, by name
        self.held: list[int] = []  # columns of effects with states that are in the nominal motion
        self.ordinary: list[tuple[int, float]] = []  # columns of ordinary differences, with standard deviations
        for name, column in baseline:
            at = self._add(column)
            if isinstance(name, str):
                self.torque_only[name] = at
            else:
                self.at[("", *name)] = at
        if lacks_friction:
            self.hypotheses.append(friction_of_all(structure.n))
        self._baseline, self._live = list(range(self.width)), live
        self._covered = covered
        known = {name for name, _, _ in self._measured}
        for effect in structure.offered:
            is_ordinary = any(p.ordinary for p in effect.parameters.values())
            if live is not None and effect.name not in live and not is_ordinary and effect.name not in known:
                continue
            if overrides(effect, "measure", "late"):
                self._sensor(effect)
            elif effect.n_states(structure.n):
                self._stateful(effect)
            else:
                self._plain(effect)
        if self._measured:
            columns = {column for key, column in self.at.items() if key in self._measured}
            self.hypotheses = not_measured(self.hypotheses, self._measured, columns)

    def _add(self, column: Column) -> int:
        """Append columns; return the index of the first."""
        self.columns.append(column)
        self.width += column.width
        return self.width - column.width

    def _plain(self, effect: Effect) -> None:
        spec = effect.parameters
        sizes, shapes = sizes_and_shapes(effect)
        is_active = effect.name in self.active
        variants = [{}] if is_active or not shapes else list(shape_variants(effect, shapes))
        first = variants[0]
        for changed in variants:
            named = {f"{effect.name}.{name}": np.array([value]) for name, value in changed.items()}
            at: dict[str, int] = {}
            for name in (*sizes, *(shapes if is_active else ())):
                slot = self.structure.slots[f"{effect.name}.{name}"]
                directions = np.zeros((self.structure.equations.n_p, slot.stop - slot.start))
                directions[slot, :] = np.eye(slot.stop - slot.start)
                at[name] = self._add(Sensitivity(directions, named))
                if is_active or not changed or changed == first:
                    for k in range(directions.shape[1]):
                        self.at[(effect.name, name, k if spec[name].per_joint else -1)] = at[name] + k
                if not changed or changed == first:
                    sds = [self._sd(effect, name, k) for k in range(directions.shape[1])]
                    self.ordinary += [(at[name] + k, sd) for k, sd in enumerate(sds) if sd]
            self._placed(effect, at, changed)

    def _sd(self, effect: Effect, name: str, k: int) -> float:
        """Return the standard deviation of a value: of its measurement, or between parts of one batch."""
        spec = effect.parameters[name]
        return self._measured.get((effect.name, name, k if spec.per_joint else -1), spec.ordinary)

    def _placed(self, effect: Effect, at: Mapping[str, int], changed: Mapping[str, float]) -> None:
        """Add the hypotheses of an effect that is linear in its sizes: at each joint, and at all alike."""
        n, spec = self.structure.n, effect.parameters
        start = {name: np.array([value]) for name, value in changed.items()} or None
        of_joints = [name for name in at if spec[name].per_joint]
        if any(spec[name].per_recording for name in at):
            self._local(effect, at, of_joints)
            return
        if not of_joints:
            self._one(effect, None, [((at[name],), name, ()) for name in at], start)
            return
        if effect.directions:
            self._along_directions(effect, at)
            return
        for j in range(n):
            self._one(effect, (j,), [((at[name] + j,), name, (j,)) for name in of_joints], start)
        everywhere = tuple(range(n))
        if n > 1 and not overrides(effect, "measure"):  # a common gain of all sensors is a change of units
            new = [name for name in of_joints if f"{effect.name}.{name}" not in self._covered]
            if new:
                alike = [(tuple(at[name] + j for j in everywhere), name, everywhere) for name in new]
                self._one(effect, everywhere, alike, start)

    def _along_directions(self, effect: Effect, at: Mapping[str, int]) -> None:
        """Add hypotheses of an effect with fixed combinations of sizes: for each, at each joint and at all alike."""
        n = self.structure.n
        for joints in [(j,) for j in range(n)] + [tuple(range(n))] * (n > 1):
            for direction in effect.directions:
                first = next(iter(direction))
                spec = effect.parameters[first]
                columns = tuple(at[name] + j for name in direction for j in joints)
                weights = tuple(factor for factor in direction.values() for _ in joints)
                least = max(effect.parameters[name].lower / factor for name, factor in direction.items())
                self.hypotheses.append(
                    Hypothesis(
                        effect.name, joints, (columns,), (Coefficient("slot", effect.name, first, joints),),
                        np.array([prior_sd(spec)]), np.array([least]), weights=(weights,),
                    )
                )  # fmt: skip

    def _one(
        self,
        effect: Effect,
        joints: tuple[int, ...] | None,
        parts: Sequence[tuple[tuple[int, ...], str, tuple[int, ...]]],
        start: Mapping[str, Array] | None,
    ) -> None:
        spec = effect.parameters
        self.hypotheses.append(
            Hypothesis(
                effect.name,
                joints,
                tuple(columns for columns, _, _ in parts),
                tuple(Coefficient("slot", effect.name, name, where) for _, name, where in parts),
                np.array([prior_sd(spec[name]) for _, name, _ in parts]),
                np.array([spec[name].lower - (spec[name].default or 0.0) for _, name, _ in parts]),
                start=start,
            )
        )

    def _local(self, effect: Effect, at: Mapping[str, int], of_joints: Sequence[str]) -> None:
        """Add the hypotheses of an effect with per-run values."""
        spec, nothing = effect.parameters, np.zeros(0)
        if not of_joints:
            (name,) = at
            places: list[tuple[tuple[int, ...] | None, tuple[int, ...]]] = [(None, (at[name],))]
        else:
            (name,) = of_joints
            every = tuple(range(self.structure.n))
            places = [((j,), (at[name] + j,)) for j in every]
            places += [(every, tuple(at[name] + j for j in every))] if len(every) > 1 else []
        for joints, columns in places:
            sd = np.full(len(columns), prior_sd(spec[name]))
            self.hypotheses.append(Hypothesis(effect.name, joints, (), (), nothing, nothing, columns, sd))
        if not effect.alike_in_all_runs:
            for joints, columns in places[: self.structure.n]:
                self._one(effect, joints, [((c,), name, joints or ()) for c in columns], None)

    def _sensor(self, effect: Effect) -> None:
        n = self.structure.n
        late = delay_of(effect)
        if late is not None:
            self._late(effect, late)
        of_readings = {name: spec for name, spec in effect.parameters.items() if name != late}
        at = {
            name: self._add(SensorSensitivity(effect.name, name, n if spec.per_joint else 1))
            for name, spec in of_readings.items()
        }
        for name, spec in of_readings.items():
            for j in range(n if spec.per_joint else 1):
                self.at[(effect.name, name, j if spec.per_joint else -1)] = at[name] + j
        self._placed(effect, at, {})

    def _late(self, effect: Effect, name: str) -> None:
        spec = effect.parameters[name]
        if self.active.get(effect.name):
            delay = float(self.active[effect.name][name][0])
            value = self._add(LateInputs(delay))
            self.held.append(value)
            log = self._add(Difference(LateInputs(delay * self.ratio), LateInputs(delay / self.ratio)))
            self._nonlinear(effect, None, value, [(log, name, ())], self.active[effect.name])
            return
        for size in GRID:
            delay = size * (spec.typical or 1.0)
            value = self._add(LateInputs(delay))
            self._nonlinear(effect, None, value, [], {name: np.array([delay])})

    def _stateful(self, effect: Effect) -> None:
        n = self.structure.n
        of_joints = [name for name, spec in effect.parameters.items() if spec.per_joint]
        params = self.active.get(effect.name)
        first, spec = next(iter(effect.parameters.items()))
        if spec.ordinary:
            absent = absent_values(effect, n)
            usual = {**absent, first: np.full_like(absent[first], spec.ordinary)}
            at = self.torque_only[f"ordinary {effect.name}"] = self._add(StatefulTorque(effect.name, usual))
            self.ordinary.append((at, ORDINARY))
            if self._live is not None and effect.name not in self._live:
                return
        if params is not None:
            self._active(effect, params, of_joints)
        if params is None or of_joints:
            taken = {j for name in of_joints for j in np.flatnonzero(params[name])} if params is not None else set()
            for values in grid(effect, n):
                joints = tuple(range(n)) if of_joints else ()
                value = self._add(StatefulTorque(effect.name, values, joints))
                for j in joints:
                    if j not in taken:
                        start = {name: only(v, j) if name in of_joints else v for name, v in values.items()}
                        self._nonlinear(effect, (j,), value + j, [], start)
                if not joints:
                    self._nonlinear(effect, None, value, [], values)

    def _active(self, effect: Effect, params: Mapping[str, Array], of_joints: Sequence[str]) -> None:
        """Add the effect's torque at its values, and its change with each fitted value."""
        joints = tuple(int(j) for j in np.flatnonzero(params[of_joints[0]])) if of_joints else ()
        value = self._add(StatefulTorque(effect.name, params, joints))
        logs = []
        for name in fitted_parameters(effect):
            changed = [within(effect.parameters[name], params[name] * by) for by in (self.ratio, 1 / self.ratio)]
            above, below = (StatefulTorque(effect.name, {**params, name: one}, joints) for one in changed)
            logs.append((self._add(Difference(above, below)), name))
        for k in range(max(len(joints), 1)):
            self.held.append(value + k)
            where = (joints[k],) if joints else ()
            self._nonlinear(
                effect, where or None, value + k, [(at + k, name, where) for at, name in logs], params
            )  # fmt: skip

    def _nonlinear(
        self,
        effect: Effect,
        joints: tuple[int, ...] | None,
        value: int,
        logs: Sequence[tuple[int, str, tuple[int, ...]]],
        start: Mapping[str, Array],
    ) -> None:
        self.hypotheses.append(at_values(effect, joints, value, logs, start))

    def held_vector(self, held: Mapping[str, float]) -> Array:
        """Return the coefficients of the columns of torque that are in the nominal motion, (P,)."""
        out = np.zeros(self.width)
        out[self.held] = 1.0
        for name, value in held.items():
            if name in self.torque_only:
                out[self.torque_only[name]] = value
        return out

    def nuisances(self, baseline_sd: Array) -> tuple[Array, Array, Array]:
        """Return the columns that all hypotheses share, with prior standard deviations and largest coefficients."""
        columns = [*self._baseline, *(at for at, _ in self.ordinary)]
        sd = np.array([sd for _, sd in self.ordinary])
        most = np.concatenate([np.full(len(self._baseline), np.inf), TOLERANCE * sd])
        return np.array(columns), np.concatenate([baseline_sd, sd]), most
