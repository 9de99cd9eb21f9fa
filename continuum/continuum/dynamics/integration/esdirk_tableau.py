"""Coefficients of the implicit Runge-Kutta methods: stiffly accurate, L-stable, explicit first stage (ESDIRK).

Source: Kennedy and Carpenter, Additive Runge-Kutta schemes for convection-diffusion-reaction equations, Applied
Numerical Mathematics 44 (2003): the implicit halves of ARK3(2)4L[2]SA and ARK4(3)6L[2]SA.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from continuum.arrays import Array


@dataclass(frozen=True)
class Tableau:
    """Stage i is y_i = y + h sum_j a_ij f_j; the last stage is the result.

    Attributes:
        a: (stages, stages), lower triangular; the diagonal is constant except for the first entry, 0.
        error: weights of the estimated error: those of the result minus those of the embedded method, (stages,).
        order: order of the result.
    """

    a: Array
    error: Array
    order: int

    @property
    def c(self) -> Array:
        """Instants of the stages in units of the step, (stages,)."""
        return np.asarray(self.a.sum(axis=1))


def third_order() -> Tableau:
    """Four stages, order 3, embedded order 2."""
    g = Fraction(1767732205903, 4055673282236)
    b = [
        Fraction(1471266399579, 7840856788654),
        Fraction(-4482444167858, 7529755066697),
        Fraction(11266239266428, 11593286722821),
        g,
    ]
    b_hat = [
        Fraction(2756255671327, 12835298489170),
        Fraction(-10771552573575, 22201958757719),
        Fraction(9247589265047, 10645013368117),
        Fraction(2193209047091, 5459859503100),
    ]
    rows = [[], [g, g], [Fraction(2746238789719, 10658868560708), Fraction(-640167445237, 6845629431997), g], b]
    return _tableau(rows, b_hat, 3)


def fourth_order() -> Tableau:
    """Six stages, order 4, embedded order 3."""
    g = Fraction(1, 4)
    b = [
        Fraction(82889, 524892),
        Fraction(0),
        Fraction(15625, 83664),
        Fraction(69875, 102672),
        Fraction(-2260, 8211),
        g,
    ]
    b_hat = [
        Fraction(4586570599, 29645900160),
        Fraction(0),
        Fraction(178811875, 945068544),
        Fraction(814220225, 1159782912),
        Fraction(-3700637, 11593932),
        Fraction(61727, 225920),
    ]
    rows = [
        [],
        [g, g],
        [Fraction(8611, 62500), Fraction(-1743, 31250), g],
        [Fraction(5012029, 34652500), Fraction(-654441, 2922500), Fraction(174375, 388108), g],
        [
            Fraction(15267082809, 155376265600),
            Fraction(-71443401, 120774400),
            Fraction(730878875, 902184768),
            Fraction(2285395, 8070912),
            g,
        ],
        b,
    ]
    return _tableau(rows, b_hat, 4)


def _tableau(rows: list[list[Fraction]], embedded: list[Fraction], order: int) -> Tableau:
    a = np.zeros((len(rows), len(rows)))
    for i, row in enumerate(rows):
        a[i, : len(row)] = [float(entry) for entry in row]
    return Tableau(a, a[-1] - np.array([float(entry) for entry in embedded]), order)
