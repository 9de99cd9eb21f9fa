"""Random planar sections, their motion and energy, and effects, for the laws of the dynamic model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import ClassVar

import numpy as np

from continuum.dynamics.balance import balance
from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.parameters import PARAMETERS, Parameter, Parameters
from continuum.dynamics.planar.instant import Instant, Motion
from continuum.dynamics.planar.rigid_body import gravity_potential, inertia_matrix
from continuum.dynamics.planar.springs_and_friction import spring_potential

_RANGES = {
    "mass": (0.1, 0.4),
    "inertia": (5e-5, 2e-4),
    "center_of_mass": (-0.01, 0.03),
    "half_spacing": (0.012, 0.03),
    "hole_radius": (0.02, 0.04),
    "stiffness": (0.5, 2.0),
    "rest_angle": (-0.2, 0.2),
    "viscous_friction": (0.01, 0.05),
    "coulomb_friction": (0.01, 0.05),
    "stribeck_gain": (0.2, 1.0),
    "stribeck_speed": (0.2, 0.6),
    "friction_slope": (3.0, 8.0),
    "capstan_friction": (0.1, 0.4),
    "cable_slope": (20.0, 60.0),
    "gravity": (5.0, 15.0),
    "hang_angle": (-3.0, 3.0),
    "rotor_inertia": (1e-5, 1e-4),
}
"""From which random parameters are drawn, in their own units; frictions smooth enough to be differentiated."""

FRICTIONLESS = {"viscous_friction": 0.0, "coulomb_friction": 0.0}
"""What takes the joints' friction away."""

PROTOTYPE = {
    "mass": 0.22257, "inertia": 79.398e-6, "center_of_mass": 0.01925, "half_spacing": 0.01925, "hole_radius": 0.032,
    "stiffness": 1.2379, "viscous_friction": 0.0314, "coulomb_friction": 0.0413, "stribeck_gain": 0.7472,
    "stribeck_speed": 0.2994, "friction_slope": 300.0,
}  # fmt: skip
"""Tables 1 and 3 of the thesis, links alike."""


def random_parameters(random: np.random.Generator, n_joints: int) -> Parameters:
    """Parameters of which every joint has its own; links are as long as their discs lie apart."""
    sizes = {name: n_joints if PARAMETERS[name].per_joint else 1 for name in _RANGES}
    return Parameters(**{name: random.uniform(*bounds, sizes[name]) for name, bounds in _RANGES.items()})


def random_model(seed: int, n_joints: int, effects: tuple[ActiveEffect, ...] = ()) -> Model:
    """A model with such parameters."""
    return Model(random_parameters(np.random.default_rng(seed), n_joints), effects)


def prototype_model(n_joints: int = 5) -> Model:
    """The prototype, hanging, or one like it with another number of joints."""
    return Model(Parameters(**{name: PARAMETERS[name].array(x, n_joints, name) for name, x in PROTOTYPE.items()}))


def moving(theta: np.ndarray, rate: np.ndarray, acceleration: np.ndarray | None = None) -> Motion:
    """Motion of the joints on a base at rest."""
    still = np.zeros(1)
    return Motion(theta, rate, 0 * theta if acceleration is None else acceleration, still, still, still)


def accelerations(model: Model, x: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Rates at which the equations hold, which are affine in them, (n + n_states,)."""
    size = model.n_joints + model.n_states
    left = balance(model, x, np.zeros(size), u)
    matrix = np.stack([balance(model, x, unit, u) - left for unit in np.eye(size)], axis=1)
    return np.linalg.solve(matrix, -left)


def energies(states: np.ndarray, model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Kinetic and potential energy of each state (times, 2 n) [J]."""
    p, n = model.parameters, model.n_joints
    kinetic, potential = [], []
    for theta, rate in zip(states[:, :n], states[:, n : 2 * n], strict=True):
        link_angle = np.cumsum(theta)
        kinetic.append(rate @ inertia_matrix(link_angle, p) @ rate / 2)
        potential.append((gravity_potential(link_angle, p) + np.sum(spring_potential(theta, p)))[0])
    return np.array(kinetic), np.array(potential)


class TipLoad(Effect):
    """A point mass on the last link: an effect that changes parameters."""

    name = "tip_load"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "mass": Parameter("m_t", "kg", 0.0, 10.0, False, "mass held by the tip", 0.0)
    }

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        """The last link heavier, its centre of mass taken as before."""
        return replace(p, mass=np.append(p.mass[:-1], p.mass[-1:] + params["mass"]))


class Wind(Effect):
    """A torque at every joint, of its own size each: an effect that pushes."""

    name = "wind"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "torque": Parameter("t_w", "N m", -1.0, 1.0, True, "torque against the joint's bend", 0.0)
    }

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """As its parameter says."""
        return params["torque"] * np.ones(now.p.n_joints)


class LaggingDrive(Effect):
    """Tensions that follow the commanded ones, z' = (u - z) / T: an effect with states, which pulls."""

    name = "lagging_drive"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "lag": Parameter("T", "s", 0.0, 10.0, False, "time constant of the drive", 0.0)
    }

    def n_states(self, n_joints: int) -> int:
        """Two tensions."""
        return 2

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        """Its states; they are the command where there is no lag."""
        return state

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        """Its states towards a tension of 2 N and 1 N."""
        return params["lag"] * state_rate + state - np.array([2.0, 1.0])


class TurningBase(Effect):
    """A base plate that turns freely by its states, angle and rate: an effect that moves the base."""

    name = "turning_base"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "tilt": Parameter("phi_b", "rad", -3.0, 3.0, False, "constant tilt across the turn", 0.0),
        "frequency": Parameter("w_b", "rad/s", 0.0, 100.0, False, "of the base's swing", 0.0),
    }

    def n_states(self, n_joints: int) -> int:
        """Angle and rate."""
        return 2

    def move_base(self, motion: Motion, params: EffectParams, state: Numbers, state_rate: Numbers) -> Motion:
        """The base where its states say."""
        return replace(
            motion,
            base_angle=motion.base_angle + params["tilt"] + state[:1],
            base_rate=motion.base_rate + state[1:],
            base_acceleration=motion.base_acceleration + state_rate[1:],
        )

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        """A harmonic oscillator."""
        return np.concatenate([state_rate[:1] - state[1:], state_rate[1:] + params["frequency"] ** 2 * state[:1]])


class Broken(Effect):
    """A torque that is no number once a joint has bent far enough, or at once."""

    name = "broken"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "limit": Parameter("l", "rad", -10.0, 10.0, False, "angle up to which it is a number", 10.0)
    }

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """A square root of what becomes negative."""
        return 1e-9 * np.sqrt(params["limit"] - now.motion.theta)


def active(effect: Effect, n_joints: int = 1, **values: float) -> ActiveEffect:
    """The effect with these values, the others at their defaults."""
    return ActiveEffect(
        effect,
        {
            name: parameter.array(values.get(name, parameter.default), n_joints, name)
            for name, parameter in effect.parameters.items()
        },
    )
