"""Following a moving tip: the rates are those of the configurations, and it comes back from out of reach."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of

from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.tracking import Tracked, Tracker

ARM = arm_of(3)
DT = 1 / 120
SPEED = 0.1


def circle(t: float, radius: float = 0.15, height: float = 0.35) -> tuple[np.ndarray, np.ndarray]:
    """Position [m] and velocity [m/s] on a level circle, run through at SPEED."""
    angle = SPEED * t / radius
    c, s = np.cos(angle), np.sin(angle)
    return np.array([radius * c, radius * s, height]), SPEED * np.array([-s, c, 0.0])


def follow(tracker: Tracker, n: int, start: int = 0, **place: float) -> list[Tracked]:
    """Answers to ``n`` poses of the circle, DT apart; the first does not continue anything."""
    answers = []
    for k in range(start, start + n):
        position, velocity = circle(k * DT, **place)
        answers.append(tracker.pose(position, velocity=velocity, dt=DT if k else None))
    return answers


@pytest.fixture(scope="module")
def answers() -> list[Tracked]:
    return follow(Tracker(ARM), 360)


def test_the_tip_stays_on_the_circle(answers: list[Tracked]) -> None:
    for k, answer in enumerate(answers):
        assert answer.result.status is IkStatus.SOLVED
        tip = arm_pose(answer.result.configuration, ARM)[:3, 3]
        np.testing.assert_allclose(tip, circle(k * DT)[0], rtol=0, atol=1e-9)


def test_rates_are_the_differences_of_the_configurations(answers: list[Tracked]) -> None:
    configurations = np.array([answer.result.configuration for answer in answers])
    rates = np.array([answer.rate for answer in answers])
    differences = (configurations[2:] - configurations[:-2]) / (2 * DT)
    assert np.max(np.abs(differences - rates[1:-1])) <= 0.01 * np.max(np.abs(rates))


def test_the_redundancy_bends_no_more_than_it_must(answers: list[Tracked]) -> None:
    """The first answer is the least bent near it: no small motion that leaves the tip in place bends less."""
    w = answers[0].result.configuration.reshape(-1)
    base = arm_pose(w.reshape(3, 2), ARM)[:3, 3]
    jacobian = np.array([arm_pose((w + 1e-6 * unit).reshape(3, 2), ARM)[:3, 3] - base for unit in np.eye(6)]).T / 1e-6
    free = w - np.linalg.pinv(jacobian) @ (jacobian @ w)
    assert np.linalg.norm(free) <= 1e-4 * np.linalg.norm(w)


def test_following_the_direction_keeps_position_and_direction() -> None:
    """The tip's path at a fixed configuration shape, turned about the base axis: position and direction turn alike."""
    tracker = Tracker(ARM, use_direction=True)
    start = arm_pose(np.array([[0.0, 0.5], [0.3, 0.9], [-0.2, 0.4]]), ARM)
    omega = np.array([0.0, 0.0, 0.5])
    configurations, rates = [], []
    for k in range(120):
        c, s = np.cos(0.5 * k * DT), np.sin(0.5 * k * DT)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        position, direction = turn @ start[:3, 3], turn @ start[:3, 2]
        answer = tracker.pose(position, direction, np.cross(omega, position), omega, DT if k else None)
        assert answer.result.solved
        pose = arm_pose(answer.result.configuration, ARM)
        np.testing.assert_allclose(pose[:3, 3], position, rtol=0, atol=1e-9)
        np.testing.assert_allclose(pose[:3, 2], direction, rtol=0, atol=1e-9)
        configurations.append(answer.result.configuration)
        rates.append(answer.rate)
    differences = (np.array(configurations[2:]) - np.array(configurations[:-2])) / (2 * DT)
    assert np.max(np.abs(differences - rates[1:-1])) <= 0.01 * np.max(np.abs(rates))


def test_without_a_velocity_no_rate_is_reported() -> None:
    tracker = Tracker(ARM)
    assert tracker.pose(circle(0.0)[0]).rate is None
    assert tracker.pose(circle(DT)[0], dt=DT).rate is None


def test_out_of_reach_the_nearest_pose_is_reported_and_back_in_reach_it_is_solved_again() -> None:
    tracker = Tracker(ARM)
    follow(tracker, 20)
    out = follow(tracker, 20, start=20, radius=0.9)
    assert all(answer.result.status in (IkStatus.UNREACHABLE, IkStatus.LIMIT_REACHED) for answer in out)
    for k, answer in enumerate(out):
        position = circle((20 + k) * DT, radius=0.9)[0]
        tip = arm_pose(answer.result.configuration, ARM)[:3, 3]
        assert answer.result.distance == pytest.approx(np.linalg.norm(tip - position), rel=1e-9)
        assert answer.result.distance == pytest.approx(out[0].result.distance, rel=1e-6)  # the arm is round
    back = follow(tracker, 60, start=40)
    assert all(answer.result.solved for answer in back)
    rates = np.array([answer.rate for answer in back[20:]])
    configurations = np.array([answer.result.configuration for answer in back[20:]])
    differences = (configurations[2:] - configurations[:-2]) / (2 * DT)
    assert np.max(np.abs(differences - rates[1:-1])) <= 0.05 * np.max(np.abs(rates))


def radial(t: float, length: float, reach: tuple[float, float], turned: float) -> np.ndarray:
    """Position [m] that goes out and in by parts of the arm's length, while its direction turns."""
    mean, change = reach
    azimuth, polar = 0.7 + turned + 0.5 * t, 0.6 + 0.5 * np.sin(t + 2 * turned)
    towards = np.array([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)])
    return length * (mean + change * np.sin(1.5 * t + turned)) * towards


@pytest.mark.parametrize(
    ("n", "bend_limit", "reach", "is_reached"),
    [(1, 3.1, (0.8, 0.1), "never"), (3, 3.1, (0.85, 0.3), "at times"), (2, 0.8, (0.75, 0.12), "never"),
     (3, 1.2, (0.75, 0.12), "at times"), (4, 1.0, (0.75, 0.12), "at times")],
)  # fmt: skip
def test_rates_are_those_of_the_motion_in_and_out_of_reach_and_at_bend_limits(
    n: int, bend_limit: float, reach: tuple[float, float], is_reached: str
) -> None:
    """At nine instants of ten and more: where the tip leaves the reach, joints turn within one interval."""
    arm, step, errors, speeds, solved, held = arm_of(n, bend_limit=bend_limit), 1e-6, [], [], [], []
    for turned in (0.0, 1.0, 2.5):
        tracker, found = Tracker(arm), list[Tracked]()
        for k in range(300):
            there, back = (radial(k * DT + side * step, arm.length, reach, turned) for side in (1, -1))
            at = radial(k * DT, arm.length, reach, turned)
            found.append(tracker.pose(at, velocity=(there - back) / (2 * step), dt=DT if k else None))
        w, rates = np.array([one.result.configuration for one in found]), np.array([one.rate for one in found])
        differences = (w[2:] - w[:-2]) / (2 * DT)
        errors.append(np.max(np.abs(differences - rates[1:-1]), axis=(1, 2)))
        speeds.append(np.max(np.abs(rates[1:-1]), axis=(1, 2)))
        solved += [one.result.solved for one in found]
        held.append(np.max(np.linalg.norm(w, axis=2)))
    assert {"never": not any(solved), "at times": any(solved) and not all(solved)}[is_reached]
    assert (max(held) > 0.999 * bend_limit) == (bend_limit < 3)
    agree = np.concatenate(errors) < 0.02 * np.median(np.concatenate(speeds))
    assert np.mean(agree) > 0.9


@pytest.mark.parametrize("n", [2, 3])
@pytest.mark.parametrize("dt", [1 / 120, 0.1])
def test_where_a_limit_is_nearly_reached_the_rate_still_moves_the_tip_as_wanted(n: int, dt: float) -> None:
    """The target turns back before the limit: whoever holds the section too early must replace what it does."""
    arm, step = arm_of(n, bend_limit=1.0), 1e-6

    def tip(t: float) -> np.ndarray:
        w = np.array([[np.cos(0.4 * k), np.sin(0.4 * k)] for k in range(n)]) * (0.6 + 0.395 * np.sin(3 * t))
        return arm_pose(w, arm)[:3, 3]

    tracker = Tracker(arm)
    for k in range(round(2.0 / dt)):
        velocity = (tip(k * dt + step) - tip(k * dt - step)) / (2 * step)
        answer = tracker.pose(tip(k * dt), velocity=velocity, dt=dt if k else None)
        if answer.result.solved:
            moved = (arm_jacobian(answer.result.configuration, arm) @ answer.rate.reshape(-1))[:3]
            assert np.linalg.norm(moved - velocity) < 0.02 * np.linalg.norm(velocity) + 1e-3


@pytest.mark.parametrize("wait", [49, 51, 101])
def test_it_comes_back_after_any_time_out_of_reach(wait: int) -> None:
    tracker = Tracker(arm_of(2))
    tracker.pose((0.05, 0.0, 0.3), velocity=np.zeros(3))
    for _ in range(wait):
        assert not tracker.pose((0.8, 0.0, 0.3), velocity=np.zeros(3), dt=DT).result.solved
    answers = [tracker.pose((0.05, 0.0, 0.3), velocity=np.zeros(3), dt=DT) for _ in range(3)]
    assert answers[-1].result.solved


def test_stuck_away_from_a_reachable_target_it_searches_again_before_long() -> None:
    """Curled up below, at its bend limit, no small steps lead to the target above; a new search finds it."""
    tracker = Tracker(arm_of(2))
    tracker.pose((-0.32, 0.093, -0.943), velocity=np.zeros(3))
    answers = [tracker.pose((0.0, 0.0, 0.38), velocity=np.zeros(3), dt=DT) for _ in range(55)]
    assert all(answer.result.solved for answer in answers[50:])


def test_a_twist_is_integrated() -> None:
    """A second along the circle by twists alone: midpoint rule, so the drift falls with the square of the step."""
    drifts = []
    for n in (60, 120):
        tracker = Tracker(ARM)
        tracker.pose(circle(0.0)[0])
        for k in range(n):
            tracker.twist(circle((k + 0.5) / n)[1], None, 1 / n)
        drifts.append(np.linalg.norm(arm_pose(tracker.configuration, ARM)[:3, 3] - circle(1.0)[0]))
    assert drifts[0] <= 1e-4
    assert drifts[1] <= 0.35 * drifts[0]


def test_a_twist_gives_the_rate_at_its_end() -> None:
    tracker = Tracker(ARM)
    tracker.pose(circle(0.0)[0])
    before = tracker.configuration
    first = tracker.twist(circle(0.0)[1], None, 1e-4).rate
    np.testing.assert_allclose(
        (tracker.configuration - before) / 1e-4, first, rtol=0, atol=1e-2 * np.max(np.abs(first))
    )


def test_a_twist_that_the_arm_cannot_follow_is_reported() -> None:
    """Stretched out it goes no farther; at its bend limit neither; and the distance is what the tip falls behind."""
    tracker = Tracker(ARM)
    up = tracker.twist(np.array([0.0, 0.0, 0.1]), None, 0.01)
    assert up.result.status is IkStatus.UNREACHABLE
    assert up.result.distance == pytest.approx(0.1 * 0.01, rel=1e-6)
    tracker.pose(circle(0.0)[0])
    side = tracker.twist(np.array([0.1, 0.0, 0.0]), None, 0.01)
    assert side.result.status is IkStatus.SOLVED
    assert side.result.distance <= 1e-3 * 0.1 * 0.01

    arm = arm_of(1, bend_limit=0.5)
    tracker = Tracker(arm)
    statuses = []
    for _ in range(60):
        before = arm_pose(tracker.configuration, arm)[:3, 3]
        answer = tracker.twist(np.array([0.2, 0.0, 0.0]), None, 0.01)
        statuses.append(answer.result.status)
    assert statuses[0] is not IkStatus.LIMIT_REACHED
    assert statuses[-1] is IkStatus.LIMIT_REACHED
    np.testing.assert_allclose(bend(tracker.configuration), 0.5, rtol=1e-12)
    np.testing.assert_allclose(arm_pose(tracker.configuration, arm)[:3, 3], before, rtol=0, atol=1e-9)
    assert answer.result.distance == pytest.approx(0.2 * 0.01, rel=1e-9)
    np.testing.assert_allclose(answer.rate, 0.0, atol=1e-9)


def test_a_twist_of_nothing_moves_nothing_and_is_solved() -> None:
    tracker = Tracker(ARM, unbend_gain=0.0)
    tracker.pose(circle(0.0)[0])
    before = tracker.configuration
    answer = tracker.twist(np.zeros(3), None, 0.1)
    assert answer.result.status is IkStatus.SOLVED
    np.testing.assert_allclose(tracker.configuration, before, rtol=0, atol=1e-12)


def test_a_jump_of_the_target_is_answered_at_once() -> None:
    """No small step leads there from one pose to the other; the answers are solved all the same."""
    tracker = Tracker(ARM)
    for k in range(12):
        position = circle(0.0)[0] * (1.0 if k % 2 else -1.0) * [1.0, 1.0, 0.0] + [0.0, 0.0, 0.3]
        answer = tracker.pose(position, velocity=np.zeros(3), dt=DT if k else None)
        assert answer.result.solved
        tip = arm_pose(answer.result.configuration, ARM)[:3, 3]
        np.testing.assert_allclose(tip, position, rtol=0, atol=1e-9)
