"""Recordings whose truth is known: a small arm simulated, and what its sensors would read of it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
from dynamics_laws import prototype_model
from effects_laws import extended

from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.measuring import lateness, readings
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.recordings.recording import Recording

N = 2
"""Joints: the fewest that pull at each other."""
SMOOTH = {"friction_slope": 5.0, "cable_slope": 30.0, "capstan_friction": 0.2}
"""Friction that may be differentiated."""
ANGLE_NOISE, RATE_NOISE = np.deg2rad(0.2), np.deg2rad(1.0)
"""Standard deviation of white noise [rad, rad/s]."""
FINE = Tolerances(1e-7, 1e-8, 0.01)
BENDS = ((0.3, 0.2), (-0.25, 0.1), (0.1, -0.3), (-0.15, -0.3))
"""From which the arm is let go, run by run [rad]."""
PULLS = Tensions([0.0, 0.05, 0.1, 0.2, 0.3, 0.6], [[0, 0], [6, 0], [6, 2], [0, 5], [4, 0], [1, 1]])


@lru_cache
def small_simulator(effect: str | None = None, tolerances: Tolerances = FINE) -> Simulator:
    """Of a small prototype whose friction is smooth, with an absent effect where one is named."""
    model = prototype_model(N).with_values(SMOOTH)
    return Simulator(model if effect is None else extended(model, effect), tolerances)


def recorded(
    simulator: Simulator,
    bend: tuple[float, ...] = BENDS[0],
    random: np.random.Generator | None = None,
    truth: Mapping[str, object] | None = None,
    seconds: float = 0.6,
    tensions: Tensions | None = None,
    rates: bool = True,
    name: str = "run",
) -> Recording:
    """A release, or a run pulled by cables, seen through sensors with white noise, or without.

    Args:
        simulator: of the model.
        bend: first joint angles [rad].
        random: where noise comes from.
        truth: values that the arm has in the place of the model's.
        seconds: length of the run, sampled 120 times a second.
        tensions: of the cables.
        rates: whether rates are measured.
        name: of the run.
    """
    model = simulator.model.with_values(truth or {})
    times = np.arange(round(120 * seconds) + 1) / 120
    u = np.zeros(2) if tensions is None else tensions.at(0.0)
    theta = np.array(bend)
    states = [a.effect.initial_state(theta, u, a.values, model.changed_parameters) for a in model.effects]
    run = simulator.around(model).run(
        np.concatenate([theta, 0 * theta, *states]),
        times,
        None if tensions is None else tensions.later(lateness(model)),
    )
    seen = readings(model, run)
    angle, rate = seen.theta, seen.theta_rate
    if random is not None:
        angle = angle + random.normal(0, ANGLE_NOISE, angle.shape)
        rate = rate + random.normal(0, RATE_NOISE, rate.shape)
    return Recording(name, times, angle, rate if rates else None, tensions)


def releases(count: int, simulator: Simulator, seed: int, truth: Mapping[str, object] | None = None) -> list[Recording]:
    """Releases from different bends, noisy."""
    random = np.random.default_rng(seed)
    return [recorded(simulator, BENDS[i], random, truth, name=f"run_{i}") for i in range(count)]
