"""Holds are where no joint moves, and their intervals hold the true angles as often as they say."""

from dataclasses import replace

import numpy as np
import pytest
from curvature_runs import RAMP, RATE, REST, measured, stops

from continuum.curvature.comparison import LEVEL
from continuum.curvature.holds import Hold, find_holds, hold_at
from continuum.curvature.median_error import median_errors
from continuum.estimation.sensor_noise import SLOW
from continuum.recordings.recording import Recording

WHITE = np.radians(0.15)
POSTURES = np.radians([[5.0, 6, 9], [12.0, 12, 12], [8.0, 9, 10], [20.0, -5, 3]])


def run(seed: int = 0, white: float = WHITE, postures: np.ndarray = POSTURES) -> Recording:
    return measured(*stops(postures), np.random.default_rng(seed), white)


def times_of(holds: list[Hold]) -> np.ndarray:
    return np.array([hold.times[[0, -1]] for hold in holds])


@pytest.mark.parametrize("white", np.radians([0.0, 0.02, 0.15, 0.4]))
def test_every_rest_is_found_and_no_motion(white: float) -> None:
    found = find_holds(run(white=white))
    begins = (REST + RAMP) * np.arange(len(POSTURES))
    np.testing.assert_allclose(times_of(found), np.stack([begins, begins + REST], axis=1), rtol=0, atol=0.25)
    for hold, posture in zip(found, POSTURES, strict=True):
        np.testing.assert_allclose(hold.theta, posture, rtol=0, atol=np.radians(0.03) + white / 4)


def test_what_swings_or_is_driven_slowly_has_no_hold() -> None:
    times = np.arange(600) / RATE
    swing = np.radians(3.0) * np.sin(2 * np.pi * 0.7 * times)[:, None] * np.ones(3)
    slow = np.radians(1.0) * times[:, None] * np.ones(3)
    for motion in (swing, slow, np.hstack([0 * swing[:, :2], swing[:, 2:]])):
        assert find_holds(measured(times, motion, np.random.default_rng(1), WHITE)) == []


def test_a_rest_shorter_than_the_shortest_counts_only_before_a_release() -> None:
    times = np.arange(240) / RATE
    let_go, pull = 30, np.zeros((240, 2))
    theta = np.where(times < times[let_go], 0.5, 0.5 * np.cos(6 * (times - times[let_go])))[:, None] * np.ones(2)
    rng = np.random.default_rng(2)
    assert find_holds(measured(times, theta, rng, WHITE)) == []
    pull[:let_go] = [18.0, 0.0]
    (hold,) = find_holds(measured(times, theta, rng, WHITE, pull))
    assert hold.rows == slice(0, let_go)
    assert hold.tension is not None
    np.testing.assert_array_equal(hold.tension, [18.0, 0.0])


@pytest.mark.parametrize("side", [1, -1])
def test_the_direction_of_the_last_motion_is_known(side: int) -> None:
    """Bent further, to the other posture, back; the first rest from straight. Mirrored, all turn round."""
    postures = side * np.radians([[5.0, 6, 9], [12.0, 12, 12], [8.0, 9, 10], [10.0, 12, 14]])
    assert [hold.approach for hold in find_holds(run(postures=postures))] == [side, side, -side, side]


def test_rows_that_are_known_to_rest_are_a_hold() -> None:
    recording = run()
    hold = hold_at(recording, slice(0, 1))
    np.testing.assert_array_equal(hold.theta, recording.theta[0])
    assert hold.tension is None


def wandering(rng: np.random.Generator, white: float, rate: float) -> tuple[Recording, np.ndarray]:
    """Sensors with an error of zero as large as assumed that wander, a random walk of ``rate`` [rad/sqrt(s)]."""
    times, theta = stops(POSTURES + rng.normal(size=POSTURES.shape) * 0.1)
    walk = rate * np.cumsum(rng.standard_normal(theta.shape), axis=0) / np.sqrt(RATE)
    seen = measured(times, theta + walk + SLOW * rng.standard_normal(theta.shape[1]), rng, white)
    return seen, theta


@pytest.mark.parametrize("rate", np.radians([0.0, 0.05, 0.15]))
def test_intervals_of_200_holds_hold_the_true_angle_as_often_as_they_say(rate: float) -> None:
    inside = []
    for seed in range(50):
        recording, theta = wandering(np.random.default_rng(seed), WHITE, rate)
        holds = find_holds(recording)
        errors = median_errors(holds)
        for k, hold in enumerate(holds):
            sd = np.sqrt(np.diag(errors.covariance(k)))
            inside.append(np.abs(hold.theta - np.median(theta[hold.rows], axis=0)) < LEVEL * sd)
    assert len(inside) >= 200
    assert 0.90 < np.mean(inside) < 0.98


def test_errors_of_one_recording_go_together_and_those_of_two_do_not() -> None:
    """The variance of a mean over holds does not fall below that of the error that they share."""
    first, second = find_holds(run(0)), find_holds(replace(run(1)))
    sensitivities = np.array([[1.0, 0, 0]])
    one = median_errors(first).variance(np.repeat(sensitivities, 4, axis=0) / 4)
    both = median_errors(first + second).variance(np.repeat(sensitivities, 8, axis=0) / 8)
    assert one > SLOW**2
    assert both == pytest.approx(one / 2, rel=0.2)


def test_a_known_sensor_error_takes_the_place_of_the_assumed_one() -> None:
    hold = hold_at(run(), slice(0, 100))
    white = np.pi / 2 * hold.noise / 100
    np.testing.assert_allclose(median_errors([hold], 0.01).covariance(0), white + 1e-4 * np.eye(3), rtol=1e-12)


@pytest.mark.parametrize("drift", [0.12, -0.05])
def test_the_bias_of_a_gyro_is_in_the_intervals_of_later_holds(drift: float) -> None:
    """Drift [deg/s] of one joint through holds far from the beginning: a random walk of its size errs far less."""
    rng, times = np.random.default_rng(4), np.arange(0.0, 40.0, 1 / 60)
    still = np.radians([7.0, 9.0, 12.0, 15.0, 18.0])
    swings = np.where((times % 10.0) < 2.0, 0.2 * np.sin(np.pi * times), 0.0)[:, None]
    theta = still + swings + np.radians(drift) * times[:, None] * [0, 0, 0, 0, 1]
    recording = Recording("drift", times, theta + np.radians(0.1) * rng.standard_normal(theta.shape))
    holds = find_holds(recording)
    errors = median_errors(holds)
    off = holds[-1].theta[4] - still[4]
    assert abs(off) > np.radians(1.0)
    assert abs(off) < 2 * np.sqrt(errors.covariance(len(holds) - 1)[4, 4])
    assert np.sqrt(errors.covariance(len(holds) - 1)[0, 0]) < np.radians(0.5)  # the joints that do not drift


def test_an_arm_that_shakes_does_not_rest() -> None:
    times = np.arange(0.0, 6.0, 1 / 120)
    theta = 0.2 + np.radians(5.0) * np.sin(2 * np.pi * 10.0 * times)[:, None] * np.ones(5)
    noise = np.radians(0.1) * np.random.default_rng(0).standard_normal(theta.shape)
    assert find_holds(Recording("shaken", times, theta + noise)) == []
    assert find_holds(Recording("still", times, 0.2 + noise)) != []
