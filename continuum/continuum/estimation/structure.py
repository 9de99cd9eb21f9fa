"""The physics of an estimation: one compiled model with all effects without states, and the effects with states.

Effects without states are all in the compiled model, absent at first, so that one function gives every derivative.
Effects with states are run along the motion one by one. Effects on sensors change readings.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.effect import Effect
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model import ActiveEffect, InputKind, Model
from continuum.dynamics.trajectory import Reading
from continuum.dynamics.values import parameter_slots, parameter_vector
from continuum.estimation.augmented_filter import Measurement
from continuum.estimation.effect_states import EffectAlongMotion
from continuum.estimation.motion_equations import MotionEquations
from continuum.estimation.run import Run, Trajectory

_ALL = slice(None)
_MECHANICAL = ("change_parameters", "move_base", "pull", "torque")


def overrides(effect: Effect, *hooks: str) -> bool:
    """Whether an effect defines any of these hooks."""
    return any(getattr(type(effect), hook) is not getattr(Effect, hook) for hook in hooks)


def delay_of(effect: Effect) -> str | None:
    """Return the parameter of an effect that is the delay of all sensors; None if it has none."""
    if not overrides(effect, "late"):
        return None
    for chosen in effect.parameters:
        if np.any(np.asarray(effect.late({name: np.array([float(name == chosen)]) for name in effect.parameters}))):
            return chosen
    return None


def absent_values(effect: Effect, n: int) -> dict[str, Array]:
    """Return the parameters of an absent effect, (n,) or (1,) each."""
    return {
        name: np.asarray(spec.array(spec.default, n, name), dtype=float) for name, spec in effect.parameters.items()
    }


class Structure:
    """The compiled model of one kind of arm and all effects that may be added to it.

    Args:
        model: model of the arm; effects that it already has stay as they are.
        effects: names of the effects that may be added; all installed effects if None.
        with_tension: whether a cable ever pulls; otherwise effects that need it are left out.
        partly: effects that may be added although the model has them, for instance at other joints.

    Attributes:
        offered, left_out: effects that may be added, and those that only a tension would show.
    """

    def __init__(
        self,
        model: Model,
        effects: Sequence[str] | None = None,
        with_tension: bool = True,
        partly: Collection[str] = (),
    ) -> None:
        n, present = model.n_joints, {active.effect.name for active in model.effects} - set(partly)
        names = effect_names() if effects is None else effects
        offered = [effect_named(name) for name in names if name not in present]
        drives = model.inputs is InputKind.JOINT_TORQUES
        self.offered = [
            effect
            for effect in offered
            if (with_tension or not effect.needs_tension)
            and not (effect.uses_cables if drives else effect.uses_drives)
            and effect.acts_on(model.parameters)
        ]
        unpulled = [effect for effect in offered if effect.needs_tension and not with_tension]
        self.left_out = [effect for effect in unpulled if not (effect.uses_cables and drives)]
        others = [active.effect for active in model.effects if active.effect.name not in {e.name for e in self.offered}]
        known = [*others, *self.offered]
        values = {active.effect.name: dict(active.values) for active in model.effects}
        plain = [e for e in known if e.n_states(n) == 0 and overrides(e, *_MECHANICAL)]
        active = tuple(ActiveEffect(e, values.get(e.name) or absent_values(e, n)) for e in plain)
        self.given, self.model = model, replace(model, effects=active)
        self.n = n
        self.equations = MotionEquations(self.model)
        self.slots = parameter_slots(self.model)
        self.stateful = {e.name: EffectAlongMotion(self.model, e) for e in known if e.n_states(n) > 0}
        self.sensors = [e for e in known if overrides(e, "measure")]
        self.late = [e for e in known if overrides(e, "late")]
        self.plain = plain
        specs = {f"{e.name}.{name}": spec for e in plain for name, spec in e.parameters.items()}
        self.bounds = {name: (spec.lower, spec.upper) for name, spec in specs.items()}

    def compile(self) -> None:
        """Make all machine code, or find it in its cache."""
        _ = self.equations.linear, self.equations.inertia, self.equations.by_parameters, self.equations.torque
        for along in self.stateful.values():
            if not overrides(along.effect, "torque_along"):
                along.compile()

    @cached_property
    def values(self) -> Array:
        """Parameter values of the compiled model as given, (n_p,)."""
        return parameter_vector(self.model)

    def measurement(self, run: Run, way: Trajectory, params: Mapping[str, Mapping[str, Array]]) -> Measurement:
        """Return the readings of a trajectory, and their derivative by it.

        Args:
            run, way: rows and trajectory.
            params: values of the effects on sensors, by effect and parameter.
        """
        expected, H = self.readings(run, way.q, way.w, params), self.reading_jacobian(run, params)
        return Measurement(expected, np.ascontiguousarray(H if run.has_rates else H[: self.n]))

    def reading_jacobian(self, run: Run, params: Mapping[str, Mapping[str, Array]]) -> Array:
        """Return d(read angles and rates) / d(true ones), the same in every row, (2 n, 2 n)."""
        n, unit = self.n, np.eye(self.n)
        still = np.zeros((n + 1, n))
        at = run.times[: n + 1]
        moved = np.concatenate([unit, np.zeros((1, n))])
        by_angle = self._read(at, moved, still, params, run.times[0])
        by_rate = self._read(at, still, moved, params, run.times[0])
        nothing = self._read(at, still, still, params, run.times[0])
        return np.hstack([(by_angle - nothing)[:n].T, (by_rate - nothing)[:n].T])

    def readings(
        self, run: Run, q: Array, w: Array, params: Mapping[str, Mapping[str, Array]], rows: slice = _ALL
    ) -> Array:
        """Return the sensors' readings of a motion in some rows of a run, (n_times, n_readings)."""
        both = self._read(run.times[rows], q, w, params, run.times[0])
        return both if run.has_rates else both[:, : self.n]

    def _read(self, times: Array, q: Array, w: Array, params: Mapping[str, Mapping[str, Array]], begun: float) -> Array:
        seen = Reading(times, q, w, float(begun))
        for effect in self.sensors:
            if effect.name in params:
                seen = effect.measure(seen, params[effect.name])
        return np.hstack([seen.theta, seen.theta_rate])


@dataclass(frozen=True)
class Point:
    """Values about which a model is linearised.

    Attributes:
        values: values of the compiled model, (n_p,).
        stateful: values of the effects with states that are in the model, by effect and parameter.
        by_run: per-run values, and those of the sensors, by effect and parameter.
    """

    values: Array
    stateful: Mapping[str, Mapping[str, Array]]
    by_run: tuple[Mapping[str, Mapping[str, Array]], ...]

    def values_in(self, structure: Structure, run: int) -> Array:
        """Return the values of the compiled model in one recording, (n_p,)."""
        values = self.values.copy()
        for effect, params in self.by_run[run].items():
            for name, value in params.items():
                if (slot := structure.slots.get(f"{effect}.{name}")) is not None:
                    values[slot] = value
        return values
