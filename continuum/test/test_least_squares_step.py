"""The damped least-squares step of the compiled solver against NumPy's."""

import numpy as np
import pytest

from continuum.kinematics.compiled.least_squares_step import least_squares_step, solve_positive_definite

SHAPES = [(3, 2), (3, 4), (3, 6), (5, 6), (6, 6), (5, 4), (6, 14)]


def step_of(jacobian: np.ndarray, error: np.ndarray, damping: float) -> np.ndarray:
    """The step; the spare rows of the Jacobian and the work space hold what must not matter."""
    m, k = jacobian.shape
    spare = np.concatenate([jacobian, np.full((6 - m, k), np.nan)])
    work, step = np.full((max(6, k), max(6, k)), np.nan), np.full(k, np.nan)
    before = error.copy()
    assert least_squares_step(spare, error, damping, work, step)
    np.testing.assert_array_equal(error, before)
    return step


@pytest.mark.parametrize(("rows", "columns"), SHAPES)
def test_undamped_it_is_least_squares_of_least_norm(rows: int, columns: int) -> None:
    random = np.random.default_rng(rows + columns)
    jacobian, error = random.normal(size=(rows, columns)), random.normal(size=rows)
    expected = np.linalg.lstsq(jacobian, error)[0]
    np.testing.assert_allclose(step_of(jacobian, error, 0.0), expected, rtol=0, atol=1e-10)


@pytest.mark.parametrize(("rows", "columns"), SHAPES)
@pytest.mark.parametrize("damping", [1e-6, 0.3, 1e3])
def test_damped_it_solves_the_normal_equations(rows: int, columns: int, damping: float) -> None:
    random = np.random.default_rng(rows * columns)
    jacobian, error = random.normal(size=(rows, columns)), random.normal(size=rows)
    step = step_of(jacobian, error, damping)
    normal = jacobian.T @ jacobian + damping * np.eye(columns)
    np.testing.assert_allclose(normal @ step, jacobian.T @ error, rtol=0, atol=1e-10 * np.max(np.abs(normal)))


def test_a_matrix_that_is_not_positive_definite_is_reported() -> None:
    zeros = np.zeros((3, 6))
    assert not least_squares_step(zeros, np.ones(3), 0.0, np.empty((6, 6)), np.empty(6))
    assert least_squares_step(zeros, np.ones(3), 1e-9, np.empty((6, 6)), np.empty(6))
    for matrix in (-np.eye(2), np.array([[1.0, 0.0], [2.0, 1.0]]), np.full((2, 2), np.nan)):
        assert not solve_positive_definite(matrix, np.ones(2))
