"""Settings of solvers that make no sense are refused by name."""

import numpy as np
import pytest

from continuum.arm import Arm, Section
from continuum.errors import InvalidValueError
from continuum.kinematics.differential import DifferentialKinematics
from continuum.kinematics.fabrikc import solve_fabrikc
from continuum.kinematics.ik_target import Target, Targets
from continuum.kinematics.inverse_kinematics import InverseKinematics
from continuum.kinematics.tracking import Tracker

ARM = Arm(tuple(Section(f"section_{i}", n_joints=5, b=0.02, a=0.03) for i in range(3)))
POINT = np.array([0.1, 0.0, 0.4])


@pytest.mark.parametrize("tolerance", [0, -1.0, float("nan"), float("inf"), 1e-17, "1e-6", None, [1e-6], True])
def test_tolerances(tolerance: object) -> None:
    with pytest.raises(InvalidValueError, match="tolerance"):
        InverseKinematics(ARM, tolerance)  # type: ignore[arg-type]
    with pytest.raises(InvalidValueError, match="tolerance"):
        solve_fabrikc(ARM, POINT, tolerance=tolerance)  # type: ignore[arg-type]


@pytest.mark.parametrize("count", [-3, 2.5, None, True, "7"])
def test_counts(count: object) -> None:
    with pytest.raises(InvalidValueError, match="n_restarts"):
        InverseKinematics(ARM, n_restarts=count)  # type: ignore[arg-type]
    with pytest.raises(InvalidValueError, match="max_iterations"):
        solve_fabrikc(ARM, POINT, max_iterations=count)  # type: ignore[arg-type]


@pytest.mark.parametrize("objective", ["shortest", None, ["first"]])
def test_objectives(objective: object) -> None:
    with pytest.raises(InvalidValueError, match="objective"):
        InverseKinematics(ARM, objective=objective)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", [0, 4, 7, -1, 600, "POSE", None])
def test_kinds(kind: object) -> None:
    with pytest.raises(InvalidValueError, match="kind"):
        DifferentialKinematics(ARM, kind)  # type: ignore[arg-type]


@pytest.mark.parametrize("target", [Targets([POINT, POINT]), Targets(np.zeros((0, 3))), POINT, None])
def test_solve_answers_one_target(target: object) -> None:
    with pytest.raises(InvalidValueError, match="target"):
        InverseKinematics(ARM).solve(target)  # type: ignore[arg-type]


@pytest.mark.parametrize("arm", ["three_sections.yaml", None, 3])
def test_an_arm_is_no_file_name(arm: object) -> None:
    for make in (InverseKinematics, DifferentialKinematics, lambda a: solve_fabrikc(a, POINT)):
        with pytest.raises(InvalidValueError, match=r"^arm is .*load_arm"):
            make(arm)  # type: ignore[arg-type]


@pytest.mark.parametrize("targets", [[POINT, POINT], POINT, None])
def test_many_targets_are_targets(targets: object) -> None:
    for answer in (InverseKinematics(ARM).solve_many, InverseKinematics(ARM).follow):
        with pytest.raises(InvalidValueError, match=r"^targets is .*Targets\("):
            answer(targets)  # type: ignore[arg-type]


@pytest.mark.parametrize("point", [["0.1", "0", "0.4"], [True, False, True], [0.1, True, 0.4], np.array([True] * 3)])
def test_words_and_truth_values_are_no_numbers(point: object) -> None:
    with pytest.raises(InvalidValueError, match=r"^position is "):
        Target(point)  # type: ignore[arg-type]


def test_the_row_that_is_not_finite_is_named() -> None:
    points = np.ones((5, 3))
    points[3, 1] = np.nan
    with pytest.raises(InvalidValueError, match=r"^positions\[3\] is \[1\.0, nan, 1\.0\]"):
        Targets(points)


@pytest.mark.parametrize("dt", [float("nan"), float("inf"), "0.1", None, [0.1]])
def test_time_steps_are_finite_numbers(dt: object) -> None:
    differential, tracker, w = DifferentialKinematics(ARM), Tracker(ARM), np.zeros((3, 2))
    with pytest.raises(InvalidValueError, match=r"^dt is "):
        differential.advance(w, w, dt)  # type: ignore[arg-type]
    with pytest.raises(InvalidValueError, match=r"^dt is "):
        tracker.twist(np.zeros(3), None, dt)  # type: ignore[arg-type]
    np.testing.assert_array_equal(tracker.configuration, 0.0)
