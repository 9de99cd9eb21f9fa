"""Effects on what is measured."""

import numpy as np
from dynamics_laws import active
from effects_laws import effect_of

from continuum.dynamics.reading import Reading


def seen_by(name: str, reading: Reading, **values: float) -> Reading:
    one = active(effect_of(name), reading.theta.shape[1], **values)
    return one.effect.measure(reading, one.values)


def test_a_delay_shows_what_was_and_begins_straight() -> None:
    cubic, times = np.polynomial.Polynomial([0.3, 1.0, -2.0, 1.5]), np.linspace(1.0, 1.5, 60)
    reading = Reading(times, cubic(times)[:, None], cubic.deriv()(times)[:, None])
    late = seen_by("sensor_delay", reading, delay=0.04)
    inside = times - 0.04 >= times[0]
    np.testing.assert_allclose(late.theta[inside, 0], cubic(times - 0.04)[inside], atol=1e-12)
    np.testing.assert_allclose(late.theta_rate[inside, 0], cubic.deriv()(times - 0.04)[inside], atol=1e-10)
    np.testing.assert_allclose(late.theta[0, 0], cubic(1.0) - 0.04 * cubic.deriv()(1.0), atol=1e-12)


def test_offset_drift_and_scale() -> None:
    times = np.linspace(2.0, 3.0, 5)
    reading = Reading(times, np.outer(times, [1.0, 2.0]), np.ones((5, 2)))
    drifted = seen_by("gyro_drift", reading, bias=0.1)
    np.testing.assert_allclose(drifted.theta - reading.theta, 0.1 * (times - 2.0)[:, None] * [1.0, 1.0], atol=1e-15)
    np.testing.assert_allclose(drifted.theta_rate, 1.1)
    np.testing.assert_allclose(seen_by("angle_offset", reading, offset=0.2).theta, reading.theta + 0.2)
    scaled = seen_by("sensor_scale", reading, gain=-0.05)
    np.testing.assert_allclose([scaled.theta, scaled.theta_rate], [0.95 * reading.theta, 0.95 * reading.theta_rate])


def test_each_recording_has_its_own_sensors_zero_and_drift() -> None:
    kinds = {name: list(effect_of(name).parameters.values()) for name in ("angle_offset", "gyro_drift", "sensor_scale")}
    assert [kinds[name][0].per_recording for name in kinds] == [True, True, False]
