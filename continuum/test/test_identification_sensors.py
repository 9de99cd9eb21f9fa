"""What a recording's sensors make of a motion, and how that changes with the motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from dynamics_laws import prototype_model

from continuum.arrays import Array
from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.reading import Reading
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.dynamics.values import parameter_vector
from continuum.effects.sensor_scale import SensorScale
from continuum.identification.recording import Recording
from continuum.identification.sensors import Sensors

N, COLUMNS, TIMES = 3, 4, np.linspace(0.0, 0.1, 13)


class Smoothed(Effect):
    """Every sample with a part of the one before it: affine in the motion, but not of each sample by itself."""

    name = "smoothed"
    parameters = {"part": Parameter("a", "1", 0.0, 1.0, False, "of the sample before", 0.0, 0.3)}  # noqa: RUF012

    def measure(self, seen: Reading, own: Own) -> Reading:
        before = np.vstack([seen.theta[:1], seen.theta[:-1]])
        return replace(seen, theta=seen.theta + own["part"] * (before - seen.theta))


class LateByNature(Effect):
    """Late by a time that is no parameter."""

    name = "late_by_nature"

    def late(self, own: Own) -> Array:
        return np.array([0.02])


def sensors_with(effect: Effect, values: dict[str, Array]) -> tuple[Sensors, Array, Recording]:
    base, random = prototype_model(N), np.random.default_rng(0)
    model = Model(base.parameters, (ActiveEffect(effect, values),))
    pull = Tensions(TIMES, np.abs(random.normal(size=(TIMES.size, 2))))
    recording = Recording("run", TIMES, *random.normal(size=(2, TIMES.size, N)), tensions=pull)
    return Sensors(model, recording), parameter_vector(model), recording


@pytest.mark.parametrize(
    ("effect", "values"),
    [(SensorScale(), {"gain": np.array([0.1, -0.2, 0.3])}), (Smoothed(), {"part": np.array([0.3])})],
    ids=["each sample by itself", "samples that hang together"],
)
def test_slopes_of_readings_are_those_of_the_motion_moved_by_each(effect: Effect, values: dict[str, Array]) -> None:
    sensors, p, _ = sensors_with(effect, values)
    random = np.random.default_rng(1)
    states, slopes = random.normal(size=(TIMES.size, 2 * N)), random.normal(size=(TIMES.size, 2 * N, COLUMNS))
    run = Trajectory(SimulationStatus.COMPLETE, TIMES, states, N, 0, 0, slopes)
    seen = sensors.readings(p, run)
    angle, rate = sensors.reading_slopes(p, run, seen, np.zeros((p.size, COLUMNS)))
    for column in range(COLUMNS):
        moved = sensors.readings(p, replace(run, states=states + slopes[:, :, column]))
        np.testing.assert_allclose(angle[:, :, column], moved.theta - seen.theta, atol=1e-12)
        np.testing.assert_allclose(rate[:, :, column], moved.theta_rate - seen.theta_rate, atol=1e-12)


def test_sensors_may_be_late_by_no_parameter() -> None:
    sensors, p, recording = sensors_with(LateByNature(), {})
    np.testing.assert_allclose(sensors.pull(p).times, recording.pull.times + 0.02)
    np.testing.assert_array_equal(sensors.lateness_slopes(p, np.zeros((p.size, 2))), np.zeros(2))
