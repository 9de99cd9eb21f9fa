"""FABRIKc: its legs are the section's, a solution stays one, hard targets get a status, most others are reached."""

import numpy as np
import pytest
from continuum_laws.samples import SECTIONS, arm_of, mixed_arm, postures, random_postures
from continuum_laws.targets import HARD_DIRECTIONS, HARD_POSITIONS, reachable_targets

from continuum.arm import Section
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import allen_from_jones, bend
from continuum.kinematics.fabrikc import leg_length, solve_fabrikc
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.section import section_pose

pytestmark = pytest.mark.slow

RIGHT_ANGLE = np.pi / 2


@pytest.mark.parametrize("section", SECTIONS, ids=lambda section: section.name)
def test_two_equal_legs_lead_from_base_to_tip(section: Section) -> None:
    for w in postures(section, largest=2.9):
        pose, leg = section_pose(w, section), leg_length(float(bend(w)), section.b, section.n_joints)
        np.testing.assert_allclose(leg * np.array([0, 0, 1]) + leg * pose[:3, 2], pose[:3, 3], rtol=0, atol=1e-13)


def test_a_start_that_meets_the_target_is_the_answer() -> None:
    arm = mixed_arm(3)
    for w in random_postures(arm, 5, seed=2, largest=1.3):
        pose = arm_pose(w, arm)
        result = solve_fabrikc(arm, pose[:3, 3], pose[:3, 2], start=w)
        assert (result.status, result.iterations) == (IkStatus.SOLVED, 0)
        np.testing.assert_allclose(result.configuration, w, rtol=0, atol=1e-12)


def test_the_position_alone_does_not_solve_position_and_direction() -> None:
    arm = mixed_arm(3)
    w = random_postures(arm, 1, seed=2, largest=1.3)[0]
    pose = arm_pose(w, arm)
    result = solve_fabrikc(arm, pose[:3, 3], pose[:3, 0], start=w, max_iterations=0)
    assert (result.status, result.iterations) == (IkStatus.NO_CONVERGENCE, 0)
    assert result.angle == pytest.approx(np.pi / 2)


@pytest.mark.parametrize(("with_direction", "share"), [(False, 0.9), (True, 0.7)])
def test_most_targets_are_reached_within_a_millimetre(with_direction: bool, share: float) -> None:
    """By position 99 of 100 were measured; with the direction within 1e-3 rad as well, some 82 of 100."""
    arm = arm_of(3, bend_limit=RIGHT_ANGLE)
    results = [
        solve_fabrikc(arm, position, direction if with_direction else None, tolerance=1e-3, max_iterations=100)
        for position, direction in reachable_targets(arm, 50, seed=3)
    ]
    assert np.mean([result.solved for result in results]) >= share


@pytest.mark.parametrize("position", HARD_POSITIONS)
@pytest.mark.parametrize("direction", HARD_DIRECTIONS)
def test_a_hard_target_gets_a_status_and_a_pose_it_attains(position: tuple, direction: tuple | None) -> None:
    arm = mixed_arm(3)
    result = solve_fabrikc(arm, position, direction, max_iterations=20)
    pose = arm_pose(result.configuration, arm)
    assert result.status in (IkStatus.SOLVED, IkStatus.NO_CONVERGENCE)
    assert result.iterations <= 20
    assert result.distance == pytest.approx(np.linalg.norm(pose[:3, 3] - position), rel=1e-12, abs=1e-15)
    assert result.solved == (result.distance <= 1e-6 and result.angle <= 1e-6)
    if direction is None:
        assert result.angle == 0.0
    else:
        unit = np.array(direction) / np.linalg.norm(direction)
        assert np.cos(result.angle) == pytest.approx(pose[:3, 2] @ unit, abs=1e-12)


@pytest.mark.parametrize("start_bend", [0.0, 0.5, 1.5])
def test_bend_limits_hold_from_any_start(start_bend: float) -> None:
    arm = arm_of(3, bend_limit=0.6)
    start = np.full((3, 2), start_bend)
    for position, direction in reachable_targets(arm_of(3, bend_limit=2.0), 10, seed=4):
        result = solve_fabrikc(arm, position, direction, start, max_iterations=10)
        assert np.all(bend(result.configuration) <= 0.6 + 1e-9)


def test_turning_the_target_about_the_base_axis_turns_the_answer() -> None:
    arm = arm_of(3, bend_limit=RIGHT_ANGLE)
    c, s = np.cos(0.9), np.sin(0.9)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    for position, direction in reachable_targets(arm, 5, seed=5):
        found = solve_fabrikc(arm, position, direction, max_iterations=5).configuration
        turned = solve_fabrikc(arm, turn @ position, turn @ direction, max_iterations=5).configuration
        np.testing.assert_allclose(turned, found @ turn[:2, :2].T, rtol=0, atol=1e-9)


def test_one_section_reaches_its_surface() -> None:
    arm = arm_of(1)
    for w in postures(arm.sections[0], largest=2.9):
        result = solve_fabrikc(arm, section_pose(w, arm.sections[0])[:3, 3])
        assert result.solved
        np.testing.assert_allclose(result.configuration, [w], rtol=0, atol=1e-4)


def test_a_start_bent_beyond_the_legs_is_taken_as_the_most_they_can() -> None:
    """At 180 degrees the legs would be parallel; the solver starts from less and does not fail."""
    arm = arm_of(2, bend_limit=np.pi)
    start = allen_from_jones(np.array([0.0, 1.0]), np.array([np.pi, np.pi]))
    for position, direction in reachable_targets(arm, 5, seed=6):
        result = solve_fabrikc(arm, position, direction, start)
        assert np.all(np.isfinite(result.configuration))
        assert result.distance <= np.linalg.norm(arm_pose(start, arm)[:3, 3] - position) + 1e-9
