"""Simulate an arm in space: its motion at given times, with an estimate of its error.

With a Stribeck effect, a joint that breaks loose runs away within a fraction of a millisecond, and which one of many
does so first may depend on any small thing: then the estimate says so, and shorter steps do not help.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Literal

import numpy as np

from continuum.arrays import Array, Booleans
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.model import InputKind
from continuum.dynamics.simulation_input import finite_array, output_times
from continuum.dynamics.spatial.arm_model import ArmModel
from continuum.dynamics.spatial.terms import body_poses, cable_terms
from continuum.dynamics.spatial.time_stepping import COMPLETE, NO_MODES, NOT_FINITE, initial_state, simulate
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import InvalidValueError

_MOST_STEPS = 10_000_000
"""Steps of a motion that end within minutes."""

STEP = 1e-3
"""Step of the motion from which the error is estimated [s]; the motion itself has half of it."""

_STATUS = {
    COMPLETE: SimulationStatus.COMPLETE,
    NOT_FINITE: SimulationStatus.NOT_FINITE,
    NO_MODES: SimulationStatus.NO_MODES,
}


@dataclass(frozen=True)
class CableCommands(InputSignal):
    """What the motor of each cable is commanded over time: a tension [N], or the length of its path [m].

    Attributes:
        holds: whether a motor holds a length, (n_cables,); None: all keep tensions.
    """

    holds: Booleans | None = None

    kind: ClassVar[InputKind] = InputKind.CABLES
    allowed: ClassVar[str] = "finite; tensions >= 0 N, lengths > 0 m"

    def __post_init__(self) -> None:
        super().__post_init__()
        holds = self.holds_length
        if holds.shape != (self.n_inputs,):
            raise InvalidValueError("shape of holds", holds.shape, f"({self.n_inputs},), as of the commands")
        wrong = (self.values < 0.0) | (holds & (self.values == 0.0))
        if wrong.any():
            raise InvalidValueError("command of a cable", float(self.values[wrong][0]), self.allowed)

    @property
    def holds_length(self) -> Booleans:
        """Whether the motor of each cable holds a length, (n_cables,)."""
        return np.zeros(self.n_inputs, bool) if self.holds is None else self.holds


@dataclass(frozen=True)
class SpatialMotion:
    """Motion of an arm in space; NaN from where a simulation failed.

    Attributes:
        status: outcome; the motion is valid only if it is COMPLETE.
        times: (n_times,) [s].
        q: angles of the degrees of freedom, (n_times, n) [rad].
        v: their rates, (n_times, n) [rad/s].
        step: longest step [s].
        error: largest difference of an angle to the motion with twice the step [rad]; NaN where one of them failed.
    """

    status: SimulationStatus
    times: Array
    q: Array
    v: Array
    step: float
    error: float


def simulate_arm(
    model: ArmModel,
    initial: Array,
    times: Array,
    commands: CableCommands | None = None,
    *,
    initial_rates: Array | None = None,
    step: float = STEP,
) -> SpatialMotion:
    """Simulate from ``times[0]`` on, with ``step`` and with half of it.

    Args:
        model: the arm.
        initial: angles at the first time, (n,) [rad].
        times: output times, increasing, (n_times,) [s].
        commands: tensions or lengths of the cables; None leaves them slack.
        initial_rates: (n,) [rad/s]; None: at rest.
        step: longest step [s].

    Raises:
        InvalidValueError: an argument has the wrong shape or is not allowed.
    """
    q0 = _state("initial angles", initial, model.n)
    v0 = np.zeros(model.n) if initial_rates is None else _state("initial rates", initial_rates, model.n)
    times = output_times(times)
    n_cables = model.cables.first.size - 1
    if commands is None:
        commands = CableCommands(np.zeros(1), np.zeros((1, n_cables)))
    if commands.n_inputs != n_cables:
        raise InvalidValueError("number of commands", commands.n_inputs, f"{n_cables}: {', '.join(model.cable_names)}")
    least = max(1e-9, float(times[-1] - times[0]) / _MOST_STEPS)
    if not least <= step < np.inf:
        raise InvalidValueError("step", step, f"a finite number of at least {least:.2g} s")
    coarse, fine = (_with_step(model, q0, v0, times, commands, step, part) for part in (1, 2))
    return replace(fine, error=float(np.abs(fine.q - coarse.q).max()))


def tip_poses(model: ArmModel, q: Array) -> tuple[Array, Array]:
    """Positions (n_times, 3) [m] and rotations (n_times, 3, 3) of the tip frame at angles ``q`` (n_times, n) [rad].

    Raises:
        InvalidValueError: the angles have another shape.
    """
    origins, rotations = body_poses(model.chain, model.checked(q))
    last, turn = rotations[:, -1], sum(section.twist for section in model.arm.sections)
    c, s = np.cos(turn), np.sin(turn)
    return origins[:, -1] + last @ model.tip, last @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def path_lengths(model: ArmModel, q: Array) -> Array:
    """Lengths of the cables from base disc to end, (n_times, n_cables) [m], at angles ``q`` (n_times, n) [rad].

    Raises:
        InvalidValueError: the angles have another shape.
    """
    return np.array([cable_terms(model.chain, model.cables, row)[0] for row in model.checked(q)]) - model.mount


def _state(name: str, given: Array, n: int) -> Array:
    values = finite_array(name, given, f"{n} finite numbers")
    if values.shape != (n,):
        raise InvalidValueError(name, given, f"{n} finite numbers")
    return values


def _with_step(
    model: ArmModel, q0: Array, v0: Array, times: Array, commands: CableCommands, step: float, parts: int
) -> SpatialMotion:
    """Simulate with equal steps of at most ``step`` [s] between two rows of any table, each cut into ``parts``."""
    rows_at, rows = commands.rows()
    holds = commands.holds_length
    rows = rows + np.where(holds, model.mount, 0.0)  # from the hole behind the base plate
    inside = rows_at[(rows_at > times[0]) & (rows_at < times[-1])]
    grid = np.unique(np.concatenate([times, inside]))
    durations = np.diff(grid)
    steps = parts * np.maximum(1, np.ceil(durations / step - 1e-9)).astype(np.int64)
    n_rows = durations.size
    state = initial_state(model.joints, q0, v0)
    q, v = np.full((2, n_rows, model.n), np.nan)
    drives = np.zeros((n_rows, model.n))
    before, after = _limits(rows_at, rows, grid[:-1], "right"), _limits(rows_at, rows, grid[1:], "left")
    status, _ = simulate(
        model.chain, model.joints, model.cables, holds, state, durations, steps, before, after, drives, drives,
        q, v,
    )  # fmt: skip
    shown = np.searchsorted(grid, times[1:]) - 1
    q, v = np.vstack([q0, q[shown]]), np.vstack([v0, v[shown]])
    longest = float((durations / steps).max(initial=0.0))
    return SpatialMotion(_STATUS[status], times, q, v, longest, np.nan)


def _limits(at: Array, values: Array, times: Array, side: Literal["left", "right"]) -> Array:
    """Values of a table, linear between its rows, just after (right) or before (left) jumps; (n_times, n_columns)."""
    if at.size == 1:
        return np.repeat(values, times.size, axis=0)
    k = np.clip(np.searchsorted(at, times, side), 1, at.size - 1)
    span = at[k] - at[k - 1]
    part = np.clip(np.where(span > 0.0, (times - at[k - 1]) / np.where(span > 0.0, span, 1.0), 1.0), 0.0, 1.0)
    return np.ascontiguousarray(values[k - 1] + part[:, None] * (values[k] - values[k - 1]))
