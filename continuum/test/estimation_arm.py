"""One compiled structure with all effects for laws of the estimation, and Eq. 12 in numbers at a given slip rate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from dynamics_laws import random_model, random_parameters

from continuum.dynamics.balance import balance
from continuum.dynamics.effect import Effect
from continuum.dynamics.model import Model
from continuum.dynamics.planar.instant import Motion
from continuum.dynamics.values import parameter_vector, with_vector
from continuum.estimation.columns import Scene
from continuum.estimation.effect_states import SubstepMotion
from continuum.estimation.friction_modes import FrictionModes
from continuum.estimation.run import Run, Trajectory
from continuum.estimation.structure import Point, Structure

N = 3


@lru_cache
def structure() -> Structure:
    """Compiled once for all modules; parameter values are arguments, so that any arm of N joints is this one."""
    return Structure(random_model(0, N))


def drawn_values(random: np.random.Generator, with_effects: bool = True, **changed: float) -> np.ndarray:
    """Parameter values of a random arm, with all effects of some size or absent, (n_p,)."""
    s = structure()
    values = s.values.copy()
    arm = Model(random_parameters(random, N))
    values[: parameter_vector(arm).size] = parameter_vector(arm)
    for effect in s.plain if with_effects else ():
        for name, params in drawn_params(effect, random).items():
            values[s.slots[f"{effect.name}.{name}"]] = params
    for name, value in changed.items():
        values[s.slots[name]] = value
    return values


def drawn_params(effect: Effect, random: np.random.Generator) -> dict[str, np.ndarray]:
    """An effect's parameters about typical, of either sign where that is allowed, every joint with its own."""
    found = {}
    for name, spec in effect.parameters.items():
        size = random.uniform(0.3, 1.5, N if spec.per_joint else 1) * spec.typical
        sign = random.choice([-1.0, 1.0], size.size) if spec.lower < 0 else 1.0
        found[name] = np.clip(spec.default + sign * size, spec.lower, spec.upper)
    return found


@dataclass(frozen=True)
class Sliding(Motion):
    """A motion whose dry friction sees rates of its own, moved along by whatever an effect adds to the joints'."""

    slip: np.ndarray = None
    joint_rates: np.ndarray = None

    @property
    def slip_rate(self) -> np.ndarray:
        return self.slip + (self.theta_rate - self.joint_rates)


def left_side(model: Model, x: np.ndarray, v: np.ndarray, u: np.ndarray, slip: np.ndarray) -> np.ndarray:
    """What is left of the equations, in numbers."""
    n, still = model.n_joints, np.zeros(1)
    return balance(model, x, v, u, Sliding(x[:n], x[n : 2 * n], v[:n], still, still, still, slip, x[n : 2 * n]))


def missing(along: SubstepMotion, values: np.ndarray, u: np.ndarray | None = None) -> np.ndarray:
    """What Eq. 12 of the structure's model misses along a motion, in numbers, (rows, n) [N m]."""
    model, u = with_vector(structure().model, values), along.u if u is None else u
    rows = zip(along.motion, u, along.slip, strict=True)
    return -np.stack([left_side(model, np.concatenate(m[:2]), m[2], u_k, slip) for m, u_k, slip in rows])


def run_over(times: np.ndarray, u: np.ndarray | None = None, with_rates: bool = True) -> Run:
    """A run with constant inputs and readings that do not matter."""
    readings = np.zeros((times.size, N * (1 + with_rates)))
    signal = np.zeros(1), np.atleast_2d(np.zeros(2) if u is None else u)
    return Run("any", times, readings, np.ones_like(readings), N, signal)


def drawn_motion(random: np.random.Generator, rows: int = 12, slowest: float = 0.0) -> SubstepMotion:
    """Instants that have nothing to do with each other; cables pull, are idle, or are let go; nothing turns slowly."""
    rate = random.normal(0, 2, (rows, N))
    rate = np.sign(rate) * (slowest + np.abs(rate))
    motion = np.stack([random.uniform(-0.5, 0.5, (rows, N)), rate, random.normal(0, 20, (rows, N))], axis=1)
    slip = rate + random.normal(0, 0.5, rate.shape)
    return SubstepMotion(motion, slip, random.uniform(0.3, 8, (rows, 2)), np.full(rows, 0.004))


def scene_along(
    along: SubstepMotion, values: np.ndarray, params: Mapping[str, Mapping[str, np.ndarray]] | None = None
) -> Scene:
    """A scene of one run whose substeps are the given instants."""
    times = np.concatenate([[0.0], np.cumsum(along.length)])
    still = np.zeros((times.size, N))
    run, way = run_over(times), Trajectory(still, still, still, still)
    return Scene(structure(), Point(values, {}, (params or {},)), 0, run, way, along, np.ones((len(along.length), N)))


def slipping(sign: np.ndarray, torque_noise: float = 1e-3) -> FrictionModes:
    """All joints slip all the time, each in the direction of its row of ``sign``, (n_times - 1, n)."""
    none = np.zeros_like(sign)
    return FrictionModes(sign, none, np.full_like(sign, torque_noise), none)


def constrained(modes: FrictionModes, joint: int, acceleration: float, rate_noise: float = 0.0) -> FrictionModes:
    """The same with one joint's acceleration given."""
    found = replace(modes, **{name: getattr(modes, name).copy() for name in vars(modes)})
    found.sign[:, joint], found.torque_noise[:, joint] = 0.0, 0.0
    found.acceleration[:, joint], found.rate_noise[:, joint] = acceleration, rate_noise
    return found
