"""Effects on what is measured."""

from dataclasses import replace

import numpy as np
import pytest
from dynamics_laws import active
from effects_laws import effect_of

from continuum.dynamics.trajectory import Reading


def seen_by(name: str, reading: Reading, **values: float) -> Reading:
    one = active(effect_of(name), reading.theta.shape[1], **values)
    return one.effect.measure(reading, one.values)


def test_offset_and_drift() -> None:
    times = np.linspace(2.0, 3.0, 5)
    reading = Reading(times, np.outer(times, [1.0, 2.0]), np.ones((5, 2)), 2.0)
    drifted = seen_by("gyro_drift", reading, bias=0.1)
    np.testing.assert_allclose(drifted.theta - reading.theta, 0.1 * (times - 2.0)[:, None] * [1.0, 1.0], atol=1e-15)
    np.testing.assert_allclose(drifted.theta_rate, 1.1)
    np.testing.assert_allclose(seen_by("angle_offset", reading, offset=0.2).theta, reading.theta + 0.2)


def a_motion() -> Reading:
    random, times = np.random.default_rng(1), np.linspace(2.0, 3.0, 5)
    return Reading(times, random.normal(size=(5, 4)), random.normal(size=(5, 4)), 2.0)


def test_a_part_of_a_recording_has_drifted_since_the_whole_began() -> None:
    whole = a_motion()
    part = replace(whole, times=whole.times[2:], theta=whole.theta[2:], theta_rate=whole.theta_rate[2:])
    drifted = seen_by("gyro_drift", part, bias=0.1).theta
    np.testing.assert_array_equal(drifted, seen_by("gyro_drift", whole, bias=0.1).theta[2:])


@pytest.mark.parametrize("sensor", range(4))
def test_a_wrong_sensor_spoils_the_joints_on_both_sides_of_it_in_opposite_ways(sensor: int) -> None:
    """By its share of how far its link is turned; of the last one, the joint before it alone."""
    true, gains = a_motion(), np.zeros(4)
    gains[sensor] = 0.05
    one = active(effect_of("sensor_scale"), 4)
    seen = one.effect.measure(true, {"gain": gains})
    for got, was in ((seen.theta, true.theta), (seen.theta_rate, true.theta_rate)):
        spoiled = np.zeros((5, 4))
        spoiled[:, sensor] = 0.05 * was[:, : sensor + 1].sum(axis=1)
        if sensor < 3:
            spoiled[:, sensor + 1] = -spoiled[:, sensor]
        np.testing.assert_allclose(got - was, spoiled, atol=1e-15)


def test_only_the_last_sensor_changes_where_the_tip_seems_to_point() -> None:
    true, gains = a_motion(), np.array([0.05, -0.04, 0.03, 0.02])
    seen = active(effect_of("sensor_scale"), 4).effect.measure(true, {"gain": gains})
    np.testing.assert_allclose(seen.theta.sum(axis=1), 1.02 * true.theta.sum(axis=1))
