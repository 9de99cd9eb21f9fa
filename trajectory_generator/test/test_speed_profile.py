"""Laws of the trapezoidal profile."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from trajectory_generator.speed_profile import Trapezoid

figures = st.floats(1e-4, 1e3)
profiles = st.builds(Trapezoid, st.just(0.0) | st.floats(1e-9, 1e3), figures, figures)


def instants(profile: Trapezoid) -> np.ndarray:
    return np.linspace(0, profile.duration, 2001)


@settings(deadline=None)
@given(profiles)
def test_it_goes_the_distance_from_rest_to_rest(profile: Trapezoid) -> None:
    ends = np.array([-1.0, 0.0, profile.duration, profile.duration + 1.0])
    assert profile.position(ends).tolist() == [0.0, 0.0, profile.distance, profile.distance]
    assert profile.velocity(ends).tolist() == [0.0] * 4
    assert profile.acceleration(ends[[0, 3]]).tolist() == [0.0, 0.0]


@settings(deadline=None)
@given(profiles)
def test_limits_hold_and_position_never_falls(profile: Trapezoid) -> None:
    t = instants(profile)
    assert profile.velocity(t).min() >= 0
    assert profile.velocity(t).max() <= profile.max_speed * (1 + 1e-12)
    assert np.abs(profile.acceleration(t)).max() <= profile.max_acceleration
    assert np.diff(profile.position(t)).min() >= -1e-12 * profile.distance


@pytest.mark.parametrize("distance", [0.3, 0.5, 2.0])
def test_velocity_and_acceleration_are_derivatives(distance: float) -> None:
    profile = Trapezoid(distance, max_speed=0.1, max_acceleration=0.02)
    steps = [0, profile.ramp_time, profile.ramp_time + profile.cruise_time, profile.duration]
    t = np.linspace(0, profile.duration, 1234)[1:-1]
    t = t[np.abs(t[:, None] - steps).min(axis=1) > 1e-3]
    step = 1e-4
    assert profile.velocity(t) == pytest.approx(
        (profile.position(t + step) - profile.position(t - step)) / (2 * step), abs=1e-10
    )
    assert profile.acceleration(t) == pytest.approx(
        (profile.velocity(t + step) - profile.velocity(t - step)) / (2 * step), abs=1e-10
    )


def test_short_way_makes_a_triangle_and_a_long_one_cruises() -> None:
    short, long = Trapezoid(0.3, 0.1, 0.02), Trapezoid(2.0, 0.1, 0.02)
    assert short.cruise_time == 0
    assert short.duration == pytest.approx(2 * (0.3 / 0.02) ** 0.5)
    assert short.velocity(np.array(short.duration / 2)) == pytest.approx((0.3 * 0.02) ** 0.5)
    assert long.duration == pytest.approx(2.0 / 0.1 + 0.1 / 0.02)
    assert long.velocity(np.array(long.duration / 2)) == pytest.approx(0.1)
