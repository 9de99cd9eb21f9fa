"""Rates of the configurations for a velocity of the tip: exact where that is possible, small where it is not."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, limited, mixed_arm, random_postures

from continuum.arm import Arm
from continuum.errors import InvalidValueError
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.configuration import bend
from continuum.kinematics.differential import (
    DIRECTION,
    POSE,
    POSITION,
    DifferentialKinematics,
    TipRate,
    least_bending,
)
from continuum.kinematics.section import configuration_from_point_jacobian, section_position

VELOCITY = np.array([0.05, -0.03, 0.02])
SPIN = np.array([0.2, 0.1, -0.3])
EVERY_KIND = [(2, POSITION), (3, POSITION), (3, DIRECTION), (4, POSE), (7, POSE), (1, POSITION)]


def regular_postures(n_sections: int, kind: int) -> tuple[Arm, list[np.ndarray]]:
    """Postures away from limits and singularities, unless one section has none for three conditions."""
    arm = mixed_arm(n_sections)
    scale = np.array([1.0] * 3 + [0.1 * arm.length] * 3)[:, None]
    kept = []
    for w in random_postures(arm, 60, seed=n_sections, largest=1.2):
        rows = scale * arm_jacobian(w, arm)
        rows[3:] = arm_pose(w, arm)[:3, :3].T @ rows[3:]
        values = np.linalg.svd(rows[:kind], compute_uv=False)
        if values[-1] > 0.025 * values[0]:
            kept.append(w)
    return arm, kept


def assert_true(output: TipRate, w: np.ndarray, arm: Arm) -> None:
    """Velocity and spin are what the rate does to the tip."""
    moved = arm_jacobian(w, arm) @ output.rate.reshape(-1)
    np.testing.assert_allclose(output.velocity, moved[:3], rtol=0, atol=1e-12)
    np.testing.assert_allclose(output.spin, moved[3:], rtol=0, atol=1e-12)


@pytest.mark.parametrize(("n_sections", "kind"), EVERY_KIND[:-1])
@pytest.mark.parametrize("wish_gain", [None, 1.0])
def test_the_tip_moves_as_asked(n_sections: int, kind: int, wish_gain: float | None) -> None:
    arm, postures = regular_postures(n_sections, kind)
    assert len(postures) > 3
    for w in postures:
        wish = None if wish_gain is None else least_bending(w, wish_gain)
        output = DifferentialKinematics(arm, kind).rate(w, VELOCITY, SPIN, wish)
        assert_true(output, w, arm)
        assert not output.held
        np.testing.assert_allclose(output.velocity, VELOCITY, rtol=0, atol=1e-9)
        local = arm_pose(w, arm)[:3, :3].T @ (output.spin - SPIN)
        np.testing.assert_allclose(local[: kind - 3], 0.0, rtol=0, atol=1e-9)


@pytest.mark.parametrize(("n_sections", "kind"), [(3, POSITION), (7, POSE)])
def test_the_wish_is_followed_as_far_as_the_tip_does_not_notice(n_sections: int, kind: int) -> None:
    arm, postures = regular_postures(n_sections, kind)
    for w in postures[:5]:
        wish = least_bending(w, 2.0)
        solver = DifferentialKinematics(arm, kind)
        with_wish, without = solver.rate(w, VELOCITY, SPIN, wish), solver.rate(w, VELOCITY, SPIN)
        extra = (with_wish.rate - without.rate).reshape(-1)
        jacobian = arm_jacobian(w, arm)[:kind]
        np.testing.assert_allclose(jacobian @ extra, 0.0, atol=1e-10)
        null = np.eye(len(extra)) - np.linalg.pinv(jacobian) @ jacobian
        np.testing.assert_allclose(extra, null @ wish.reshape(-1), atol=1e-10)
        np.testing.assert_allclose(null @ without.rate.reshape(-1), 0.0, atol=1e-10)  # the smallest without a wish


@pytest.mark.parametrize("twist", [0.0, 0.7])
def test_one_section_follows_eq_22(twist: float) -> None:
    """For any velocity, be it one that the tip of one section cannot have."""
    arm = arm_of(1, twist=twist)
    c, s = np.cos(twist), np.sin(twist)
    for w in random_postures(arm, 10, seed=1, largest=2.0):
        for velocity in (arm_jacobian(w, arm)[:3] @ [0.4, -0.2], VELOCITY):
            seen = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) @ velocity
            eq_22 = configuration_from_point_jacobian(section_position(w, arm.sections[0]))[0] @ seen
            output = DifferentialKinematics(arm).rate(w, velocity)
            assert_true(output, w, arm)
            np.testing.assert_allclose(output.rate[0], eq_22, rtol=0, atol=1e-9)


def test_one_section_at_its_limit_is_held() -> None:
    arm, w = arm_of(1, 1.0), np.array([[0.6, 0.8]])
    tip = section_position(w[0], arm.sections[0])
    output = DifferentialKinematics(arm).rate(w, tip * [1.0, 1.0, -1.0])
    assert output.held
    assert abs(output.rate[0] @ w[0]) <= 1e-12
    back = DifferentialKinematics(arm).rate(w, -tip * [1.0, 1.0, -1.0])
    assert not back.held
    assert back.rate[0] @ w[0] < -0.1


@pytest.mark.parametrize("bend_of_all", [0.0, 1e-300, 1e-12, 1e-6, 1e-3])
def test_near_the_straight_arm_the_rate_stays_small_and_the_lack_is_reported(bend_of_all: float) -> None:
    """The straight arm cannot move along its axis; asked to, it neither jumps nor fails."""
    arm = arm_of(3)
    w = np.full((3, 2), bend_of_all)
    output = DifferentialKinematics(arm).rate(w, np.array([0.03, 0.0, -0.1]))
    assert_true(output, w, arm)
    assert np.max(np.abs(output.rate)) < 20.0
    if bend_of_all < 1e-5:
        np.testing.assert_allclose(output.velocity, [0.03, 0.0, 0.0], rtol=0, atol=1e-3)


def test_damping_sets_in_smoothly() -> None:
    """Along a path from a regular posture into the straight one the rates change without a jump."""
    arm = arm_of(2)
    shape = np.array([[0.5, 0.3], [-0.2, 0.7]])
    steps = np.linspace(1.0, 0.0, 4001)
    rates = np.array([DifferentialKinematics(arm).rate(s * shape, VELOCITY).rate for s in steps])
    assert np.max(np.abs(np.diff(rates, axis=0))) <= 0.02 * np.max(np.abs(rates))


@pytest.mark.parametrize("wish_gain", [0.0, 0.1, 1.0])
@pytest.mark.parametrize("at_limit", [(1,), (0, 2), (1, 3)], ids=str)
def test_sections_at_their_limit_are_held_and_the_tip_still_moves_as_asked(wish_gain: float, at_limit: tuple) -> None:
    arm = arm_of(5, bend_limit=1.0)
    n_held = n_free = 0
    for w in random_postures(arm, 60, seed=3, largest=0.9):
        for i in at_limit:
            w[i] *= 1.0 / bend(w[i])
        output = DifferentialKinematics(arm).rate(w, 5 * VELOCITY, wish=least_bending(w, wish_gain))
        assert_true(output, w, arm)
        outward = np.array([output.rate[i] @ w[i] for i in at_limit])
        assert np.all(outward <= 1e-12)
        stopped = np.abs(outward) <= 1e-12
        assert output.held == np.any(stopped)
        n_free += not output.held
        n_held += np.all(stopped)
        np.testing.assert_allclose(output.velocity, 5 * VELOCITY, rtol=0, atol=1e-9)
    assert n_free > 1
    assert n_held > 1 or wish_gain == 1.0  # so strong a wish unbends one of two


def test_what_is_held_gives_way_to_no_wish() -> None:
    """All sections at their limit and a wish to bend on: no rate goes outward."""
    arm = limited(arm_of(3), (0.4, 0.4, 0.4))
    w = np.array([[0.4, 0.0], [0.0, 0.4], [-0.4, 0.0]])
    output = DifferentialKinematics(arm).rate(w, (0.0, 0.0, 0.0), wish=5.0 * w)
    assert output.held
    assert np.all(np.sum(output.rate * w, axis=-1) <= 1e-12)


def test_advance_keeps_the_limits_and_else_adds() -> None:
    arm = arm_of(2, bend_limit=1.0)
    w = np.array([[0.6, 0.7], [0.1, 0.0]])
    moved = DifferentialKinematics(arm).advance(w, np.array([[2.0, 2.0], [1.0, -1.0]]), 0.5)
    np.testing.assert_allclose(moved, [[1.6 / np.hypot(1.6, 1.7), 1.7 / np.hypot(1.6, 1.7)], [0.6, -0.5]], rtol=1e-15)
    np.testing.assert_array_equal(w, [[0.6, 0.7], [0.1, 0.0]])


@pytest.mark.parametrize("bad", [(0.0, 0.0), (np.nan, 0.0, 0.0), "abc", None, np.zeros((3, 1))])
def test_malformed_input_is_refused_by_name(bad: object) -> None:
    solver, w = DifferentialKinematics(arm_of(2)), np.zeros((2, 2))
    with pytest.raises(InvalidValueError, match=r"^velocity is "):
        solver.rate(w, bad)
    with pytest.raises(InvalidValueError, match=r"^spin is "):
        solver.rate(w, VELOCITY, bad)
    if bad is not None:
        with pytest.raises(InvalidValueError):
            solver.rate(bad, VELOCITY)
        with pytest.raises(InvalidValueError):
            solver.rate(w, VELOCITY, wish=bad)
