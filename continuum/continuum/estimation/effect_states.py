"""Effects with states along a given motion: the torque that they add, by implicit Euler steps.

The states obey the effect's `state_balance`; the motion is given, so only they are solved for. A step that does not
converge is halved.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.compiled.machine_code import address_of
from continuum.dynamics.effect import Effect
from continuum.dynamics.integration.compiled_loops import call_at
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.values import with_vector
from continuum.estimation.compiled_loops import compiled, entry_point
from continuum.estimation.motion_equations import MotionEquations, packed, torques

_ITERATIONS = 25  # of Newton's method in a step
_STEP = 2.1e-3  # s, longest step: in it, implicit Euler damps swings of 100 rad/s by a fifth
_PARTS = 256  # most parts into which a step is divided


@dataclass(frozen=True)
class SubstepMotion:
    """A run's motion between its samples, one row for each substep.

    Attributes:
        motion: angles, rates and accelerations in the middle of each substep, (rows, 3, n) [rad, rad/s, rad/s2].
        slip: rates that dry friction depends on, (rows, n) [rad/s].
        u: inputs in each substep, (rows, n_inputs).
        length: length of each substep, (rows,) [s].
    """

    motion: Array
    slip: Array
    u: Array
    length: Array


class EffectAlongMotion:
    """An effect with states, added to a model without states.

    Args:
        model: model without states to which the effect is added.
        effect: effect with states.
    """

    def __init__(self, model: Model, effect: Effect) -> None:
        absent = {name: spec.array(spec.default, model.n_joints, name) for name, spec in effect.parameters.items()}
        self.effect, self._base = effect, model
        self._extended = replace(model, effects=(*model.effects, ActiveEffect(effect, absent)))

    @cached_property
    def _with(self) -> MotionEquations:
        return MotionEquations(self._extended)

    def compile(self) -> None:
        """Make the machine code, or find it in its cache."""
        _ = self._with.state_step, self._with.torque

    def torque(self, along: SubstepMotion, p: Array, params: Mapping[str, Array], without: Array) -> Array:
        """Return what the effect adds to the joints' torques, (rows, n) [N m].

        Args:
            along: the motion.
            p: values of the model's parameters without the effect, (n_p,).
            params: the effect's values, (n,) or (1,) each.
            without: torque missing in Eq. 12 without the effect, (rows, n) [N m].
        """
        n, parameters = self._base.n_joints, with_vector(self._base, p).changed_parameters
        quasi_static = self.effect.torque_along(along.motion, along.slip, along.length, params, parameters)
        if quasi_static is not None:
            return -quasi_static
        z0 = np.asarray(self.effect.initial_state(along.motion[0, 0], along.u[0], params, parameters), dtype=float)
        extended = np.concatenate([p, *(np.asarray(params[name], dtype=float) for name in self.effect.parameters)])
        nothing = np.zeros((len(along.motion), z0.size))
        rows = packed(along.motion, along.u, along.slip, extended, nothing, nothing)
        z, rate = _states(address_of(self._with.state_step), rows, along.length, z0, n)
        rows = packed(along.motion, along.u, along.slip, extended, z, rate)
        return torques(self._with, rows, n) - without


@entry_point
def _states(address: int, rows: Array, length: Array, z0: Array, n: int) -> tuple[Array, Array]:
    """Return the states and their rates at every row, (rows, n_states) each; row 0 is reached from ``z0``."""
    size = z0.size
    at, at_rate = 2 * n, 3 * n + size
    z_out, rate_out = np.zeros((len(rows), size)), np.zeros((len(rows), size))
    z, given = z0.copy(), np.empty(rows.shape[1] + 1)
    for k in range(len(rows)):
        parts = max(1, int(np.ceil(length[k] / _STEP)))
        while True:
            begin, converged = z.copy(), True
            for part in range(parts):
                share = (part + 1) / parts
                before = rows[max(k - 1, 0)]
                for i in range(rows.shape[1]):
                    given[i] = before[i] + (rows[k, i] - before[i]) * share
                converged = _newton(address, given, begin, at, at_rate, length[k] / parts)
                if not converged:
                    break
            if converged or parts >= _PARTS:
                break
            parts *= 2
        if converged:
            rate_out[k] = given[at_rate : at_rate + size]
            z = begin
        z_out[k] = z
    return z_out, rate_out


@compiled
def _newton(address: int, given: Array, z: Array, at: int, at_rate: int, step: float) -> bool:
    """Take one implicit Euler step of the states ``z``, in place if it converges; return whether it does."""
    size = z.size
    before, now, out = z.copy(), z.copy(), np.empty(2 * size)
    given[-1] = 1.0 / step
    _evaluated(address, given, now, before, at, at_rate, step, out)
    for _ in range(_ITERATIONS):
        move = out[size:].copy()
        large = 0.0
        for i in range(size):
            large = max(large, abs(move[i]) / (1e-3 + abs(now[i])))
        if not large < 1e300:
            return False
        share, better = 1.0, False
        while share > 1e-3:
            trial = now + share * move
            _evaluated(address, given, trial, before, at, at_rate, step, out)
            left = 0.0
            for i in range(size):
                left = max(left, abs(out[size + i]) / (1e-3 + abs(now[i])))
            if left <= (1 - share / 4) * large or left < 1e-7:
                better = True
                break
            share /= 2
        if not better:
            return False
        now = trial
        if left < 1e-7:
            z[:] = now
            return True
    return False


@compiled
def _evaluated(
    address: int, given: Array, z: Array, before: Array, at: int, at_rate: int, step: float, out: Array
) -> None:
    for i in range(z.size):
        given[at + i] = z[i]
        given[at_rate + i] = (z[i] - before[i]) / step
    call_at(address, given, out)
