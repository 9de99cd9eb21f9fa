"""Tensions that hold from row to row: jumps are neither smeared nor late."""

import numpy as np

from continuum.dynamics.integration.scipy_bdf import simulate_bdf
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.values import shared_directions

MODEL = load_model("lamecc_prototype.yaml")
TIMES = np.array([0.0, 0.1, 0.2, 0.3])
VALUES = np.array([[0.0, 0.0], [20.0, 1.0], [20.0, 1.0], [3.0, 9.0]])
HELD = Tensions(TIMES, VALUES, held=True)


def test_a_row_holds_until_the_next() -> None:
    for t, row in ((-1.0, 0), (0.0, 0), (0.0999, 0), (0.1, 1), (0.25, 2), (0.3, 3), (9.0, 3)):
        np.testing.assert_array_equal(HELD.at(t), VALUES[row])


def test_held_tensions_are_the_limit_of_steep_ramps() -> None:
    limits, out = Tolerances(1e-7, 1e-8, 0.01), np.linspace(0.0, 0.4, 41)
    steep = Tensions(
        np.array([0.0, 0.1 - 1e-6, 0.1, 0.3 - 1e-6, 0.3]),
        np.array([[0.0, 0.0], [0.0, 0.0], [20.0, 1.0], [20.0, 1.0], [3.0, 9.0]]),
    )
    simulator = Simulator(MODEL, limits)
    held, ramped = (simulator.run(np.zeros(5), out, tensions) for tensions in (HELD, steep))
    np.testing.assert_allclose(held.theta, ramped.theta, rtol=0, atol=2e-5)
    assert np.ptp(held.theta) > 0.1


def test_the_reference_integrator_sees_the_same_jumps() -> None:
    out = np.linspace(0.0, 0.2, 21)
    fast = Simulator(MODEL, Tolerances(1e-6, 1e-7, 0.002)).run(np.zeros(5), out, HELD)
    slow = simulate_bdf(MODEL, np.zeros(5), out, HELD, Tolerances(1e-6, 1e-7, 0.0005))
    np.testing.assert_allclose(fast.theta, slow.theta, rtol=0, atol=5e-4)


def test_rates_are_begun_again_after_a_jump() -> None:
    """From rest, the first instants after a jump are a parabola; the rates before it would delay them."""
    step = Tensions(np.array([0.0, 0.05]), np.array([[0.0, 0.0], [30.0, 0.0]]), held=True)
    late = Simulator(MODEL).run(np.zeros(5), np.array([0.0, 0.05, 0.055]), step)
    now = Simulator(MODEL).run(np.zeros(5), np.array([0.0, 0.005]), Tensions(np.zeros(1), np.array([[30.0, 0.0]])))
    np.testing.assert_allclose(late.theta[-1], now.theta[-1], rtol=0.02)


def test_derivatives_after_a_jump_are_those_of_the_trajectory() -> None:
    simulator, out = Simulator(MODEL, Tolerances(1e-7, 1e-8, 0.01)), np.array([0.0, 0.12])
    p = simulator.equations.values
    free = shared_directions(MODEL, ["stiffness"])
    slope = simulator.run(np.full(5, 0.1), out, HELD, free=free).sensitivities[-1, :, 0]
    moved = [simulator.run(np.full(5, 0.1), out, HELD, values=p + sign * 1e-5 * free[:, 0]) for sign in (1, -1)]
    np.testing.assert_allclose(slope, (moved[0].states[-1] - moved[1].states[-1]) / 2e-5, rtol=0.02, atol=1e-3)
