"""Targets: what is taken, what is refused and by which name, and how hard ones are answered."""

import numpy as np
import pytest
from continuum_laws.samples import arm_of, mixed_arm, random_postures
from continuum_laws.targets import HARD_DIRECTIONS, HARD_POSITIONS, MALFORMED_VECTORS

from continuum.arm import Arm
from continuum.errors import InvalidValueError
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.compiled.solver import run_solver
from continuum.kinematics.configuration import bend
from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.ik_target import DIRECTION, POSE, POSITION, Target, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics, solve

HALF_TURN = np.diag([1.0, -1.0, -1.0])
HARDER_POSITIONS = (*HARD_POSITIONS, (0.0, 0.0, 1e-300), (1e12, 0.0, 0.0), (0.0, 0.0, 0.1925), (0.0, 0.0, 0.385))


@pytest.mark.parametrize("position", HARDER_POSITIONS)
@pytest.mark.parametrize("direction", HARD_DIRECTIONS)
@pytest.mark.parametrize("arm", [arm_of(1), arm_of(2), mixed_arm(3)], ids=["one", "two", "three"])
def test_a_hard_target_gets_a_true_answer(arm: Arm, position: tuple, direction: tuple | None) -> None:
    result = solve(arm, position, direction)
    pose = arm_pose(result.configuration, arm)
    assert result.status in IkStatus
    assert result.solved == (result.distance <= 1e-6 and result.angle <= 1e-6)
    assert result.distance == pytest.approx(np.linalg.norm(pose[:3, 3] - position), rel=1e-12, abs=1e-15)
    if direction is None:
        assert result.angle == 0.0
    else:
        assert np.cos(result.angle) == pytest.approx(pose[:3, 2] @ direction / np.linalg.norm(direction), abs=1e-12)
    assert np.all(bend(result.configuration) <= [section.bend_limit + 1e-9 for section in arm.sections])


@pytest.mark.parametrize("rotation", [np.eye(3), HALF_TURN, np.diag([-1.0, -1.0, 1.0])])
def test_a_hard_rotation_gets_a_status(rotation: np.ndarray) -> None:
    for position in HARD_POSITIONS:
        result = InverseKinematics(arm_of(3)).solve(Target(position, rotation=rotation))
        turn = np.trace(arm_pose(result.configuration, arm_of(3))[:3, :3].T @ rotation)
        assert 1.0 + 2.0 * np.cos(result.angle) == pytest.approx(turn, abs=1e-9)


@pytest.mark.parametrize("vector", MALFORMED_VECTORS)
def test_malformed_vectors_are_refused_by_name(vector: object) -> None:
    with pytest.raises(InvalidValueError, match=r"^position is "):
        Target(vector)
    with pytest.raises(InvalidValueError, match=r"^positions is "):
        Targets([vector])
    if vector is not None:
        with pytest.raises(InvalidValueError, match=r"^direction is "):
            Target((0.1, 0.0, 0.2), vector)
        with pytest.raises(InvalidValueError, match=r"^directions is "):
            Targets([(0.1, 0.0, 0.2)], vector)
        with pytest.raises(InvalidValueError, match=r"^rotation is "):
            Target((0.1, 0.0, 0.2), rotation=vector)


def test_a_direction_without_length_is_refused() -> None:
    with pytest.raises(InvalidValueError, match=r"^direction is \[0\.0, 0\.0, 0\.0\]; allowed: .* not all zero$"):
        Target((0.1, 0.0, 0.2), (0.0, 0.0, 0.0))
    with pytest.raises(InvalidValueError, match=r"^direction is \[0\.0, 0\.0, 0\.0\]"):
        Targets(np.ones((3, 3)), np.array([[0, 0, 1.0], [0, 0, 0], [1.0, 0, 0]]))


@pytest.mark.parametrize(
    "rotation", [-np.eye(3), 2 * np.eye(3), np.eye(3)[[1, 0, 2]], np.eye(3) + 1e-5, np.zeros((3, 3))]
)
def test_only_rotations_are_rotations(rotation: np.ndarray) -> None:
    with pytest.raises(InvalidValueError, match=r"^rotation is .*right-handed"):
        Target((0.1, 0.0, 0.2), rotation=rotation)
    with pytest.raises(InvalidValueError, match=r"^rotation is .*right-handed"):
        Targets(np.ones((2, 3)), rotations=np.stack([np.eye(3), rotation]))


def test_direction_and_rotation_exclude_each_other() -> None:
    with pytest.raises(InvalidValueError, match=r"^directions is "):
        Target((0.1, 0.0, 0.2), (0.0, 0.0, 1.0), np.eye(3))


def test_as_many_directions_and_rotations_as_positions() -> None:
    for directions, rotations in ((np.ones((2, 3)), None), (None, np.stack([np.eye(3)] * 2))):
        with pytest.raises(InvalidValueError, match=r"^(directions|rotations) is "):
            Targets(np.ones((3, 3)), directions, rotations)


def test_kinds_and_what_is_kept() -> None:
    assert Target((0.1, 0.0, 0.2)).kind == POSITION
    assert Target((0.1, 0.0, 0.2), (0.0, 0.0, 2.0)).kind == DIRECTION
    assert Target((0.1, 0.0, 0.2), rotation=np.eye(3)).kind == POSE
    np.testing.assert_allclose(Target((0.1, 0.0, 0.2), (3.0, 0.0, 4.0)).direction, [0.6, 0.0, 0.8], rtol=1e-15)
    assert Target((0.1, 0.0, 0.2)).direction is None


def test_a_target_is_a_copy() -> None:
    position = np.array([0.1, 0.0, 0.2])
    target = Target(position)
    position[:] = 7.0
    np.testing.assert_array_equal(target.position, [0.1, 0.0, 0.2])


def test_large_numbers_are_finite_and_long_directions_have_a_length() -> None:
    np.testing.assert_array_equal(Target((1e200, -1e308, 0.0)).position, [1e200, -1e308, 0.0])
    np.testing.assert_allclose(Target((0, 0, 1), (3e200, 0.0, 4e200)).direction, [0.6, 0.0, 0.8], rtol=1e-15)
    np.testing.assert_allclose(Targets(2.0 * np.eye(3), 1e300 * np.eye(3)).directions, np.eye(3), rtol=1e-15)


def test_no_input_makes_the_solver_compile_again() -> None:
    """Transposed matrices, integers, strides: compiled once for all, so that no node waits for a compiler."""
    arm = arm_of(3)
    w = random_postures(arm, 2, seed=1)
    pose = arm_pose(w, arm)
    solve(arm, pose[0, :3, 3])
    count = len(run_solver.signatures)
    back = np.ascontiguousarray(pose[:, :3, :3].swapaxes(1, 2))
    ik = InverseKinematics(arm, tolerance=1)
    positions = np.asfortranarray(pose[:, :3, 3])
    ik.solve_many(Targets(positions, rotations=back.swapaxes(1, 2)), np.asfortranarray(w))
    ik.solve_many(Targets(positions, np.asfortranarray(pose[:, :3, 2])))
    ik.solve(Target(pose[0, :3, 3], rotation=back[0].T), np.asfortranarray(w[0]))
    ik.follow(Targets([[0, 0, 1]], [[0, 0, 1]]), w[0].tolist())
    InverseKinematics(arm, n_restarts=0).solve(Target((0, 0, 1)))
    assert len(run_solver.signatures) == count
