"""The even functions against their power series summed in exact fractions."""

from collections.abc import Callable
from fractions import Fraction
from math import factorial

import numpy as np
import pytest

from continuum.kinematics.smooth_functions import one_minus_sinc, sinc, sinc_derivative, versine

POINTS = [0.0, 1e-300, 1e-12, 1e-8, 1e-4, 0.01, 0.1, 0.3, 0.4999999, 0.5, 0.5000001, 0.6, 1.0, 2.0, 3.0, 4.0, 5.5, 6.5]

COEFFICIENTS = {
    sinc: lambda k: Fraction(1, factorial(2 * k + 1)),
    versine: lambda k: Fraction(1, factorial(2 * k + 2)),
    one_minus_sinc: lambda k: Fraction(1, factorial(2 * k + 3)),
    sinc_derivative: lambda k: -Fraction(2 * k + 2, factorial(2 * k + 3)),
}


@pytest.mark.parametrize("function", COEFFICIENTS, ids=lambda function: function.__name__)
def test_equals_its_power_series(function: Callable[[np.ndarray], np.ndarray]) -> None:
    coefficient = COEFFICIENTS[function]
    exact = np.array([float(sum(coefficient(k) * (-(Fraction(x) ** 2)) ** k for k in range(30))) for x in POINTS])
    found = function(np.array(POINTS))
    assert np.max(np.abs(found - exact)) <= 6e-15 * abs(exact[0])


@pytest.mark.parametrize("function", COEFFICIENTS, ids=lambda function: function.__name__)
def test_is_even(function: Callable[[np.ndarray], np.ndarray]) -> None:
    x = np.array(POINTS)
    np.testing.assert_array_equal(function(-x), function(x))
