"""The Runge-Kutta methods' order conditions and stability, their measured order of convergence, and exact solutions."""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from dynamics_laws import FRICTIONLESS, prototype_model, random_model

from continuum.dynamics.integration.esdirk_tableau import Tableau, fourth_order, third_order
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model, with_dry_friction
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus

each_method = pytest.mark.parametrize("method", [third_order, fourth_order])
Method = Callable[[], Tableau]


def order_defects(a: np.ndarray, b: np.ndarray, order: int) -> list[float]:
    """What is left of the conditions of every rooted tree with ``order`` vertices (Hairer, Norsett and Wanner II.2)."""
    one, c = np.ones(len(b)), a.sum(axis=1)
    trees = {
        1: [(one, 1)],
        2: [(c, 2)],
        3: [(c**2, 3), (a @ c, 6)],
        4: [(c**3, 4), (c * (a @ c), 8), (a @ c**2, 12), (a @ a @ c, 24)],
        5: [(c**4, 5), (c**2 * (a @ c), 10), ((a @ c) ** 2, 20), (c * (a @ c**2), 15), (a @ c**3, 20)],
    }
    return [float(b @ tree - 1 / weight) for tree, weight in trees[order]]


@each_method
def test_order_conditions(method: Method) -> None:
    tableau = method()
    b, order = tableau.a[-1], tableau.order
    for upto in range(1, order + 1):
        np.testing.assert_allclose(order_defects(tableau.a, b, upto), 0, atol=2e-15)
    assert np.abs(order_defects(tableau.a, b, order + 1)).max() > 1e-4
    embedded = b - tableau.error
    for upto in range(1, order):
        np.testing.assert_allclose(order_defects(tableau.a, embedded, upto), 0, atol=2e-15)
    assert np.abs(order_defects(tableau.a, embedded, order)).max() > 1e-4  # else the error is not seen


@each_method
def test_stability(method: Method) -> None:
    """|R| <= 1 on the imaginary axis, and 0 at infinity: L-stable."""
    a = method().a
    one = np.ones(len(a))

    def R(z: complex) -> complex:
        return 1 + z * (a[-1] @ np.linalg.solve(np.eye(len(a)) - z * a, one))

    assert max(abs(R(1j * y)) for y in np.geomspace(1e-3, 1e6, 400)) <= 1 + 1e-12
    assert abs(R(-1e9)) < 1e-7
    np.testing.assert_allclose(R(-1e-2), np.exp(-1e-2), rtol=1e-8)


SMOOTH = random_model(21, 2).with_values({"friction_slope": 1.0, "stribeck_gain": 0.0, "inertia": 5e-3})
"""Friction without corners, and links so slow that fifty steps see all that happens."""


def ten_states(tableau: Tableau, count: int) -> np.ndarray:
    """After every tenth of 0.4 s, in ``count`` steps at least; stages are solved far more exactly than steps are."""
    x0, times = np.array([0.3, -0.2, 1.0, -2.0]), np.linspace(0.0, 0.4, count + 1)
    found = Simulator(SMOOTH, Tolerances(1e-12, 1e-12, 0.4001 / count), tableau).run(x0, times)
    assert found.status is SimulationStatus.COMPLETE
    return found.states[:: count // 10]


@each_method
def test_measured_order_of_convergence(method: Method) -> None:
    """Fixed steps: outputs as far apart as the longest step, and no estimate of the error that could shorten it."""
    blind = replace(method(), error=np.zeros_like(method().error))
    exact = ten_states(fourth_order(), 100)
    errors = [np.linalg.norm(ten_states(blind, count) - exact) for count in (60, 120, 240)]
    np.testing.assert_allclose(-np.diff(np.log2(errors)), method().order, rtol=0, atol=0.3)


@lru_cache
def oscillator() -> Model:
    """One joint with spring and viscous friction alone: damped harmonic motion."""
    return prototype_model(1).with_values(FRICTIONLESS | {"viscous_friction": 0.005, "gravity": 0.0})


def oscillation(times: np.ndarray, start: float) -> np.ndarray:
    p = oscillator().parameters
    inertia = p.inertia[0] + p.mass[0] * p.center_of_mass[0] ** 2
    decay, square = p.viscous_friction[0] / (2 * inertia), p.stiffness[0] / inertia
    w = np.sqrt(square - decay**2)
    return start * np.exp(-decay * times) * (np.cos(w * times) + decay / w * np.sin(w * times))


@each_method
@pytest.mark.parametrize("relative", [1e-4, 1e-7, 1e-10])
def test_errors_follow_the_tolerance_on_an_exact_solution(method: Method, relative: float) -> None:
    times = np.linspace(0.0, 0.3, 31)
    found = Simulator(oscillator(), Tolerances(relative, relative / 10, 1.0), method()).run(np.array([0.4]), times)
    error = np.abs(found.theta[:, 0] - oscillation(times, 0.4)).max()
    assert error < 30 * relative


@each_method
def test_steps_end_on_every_output(method: Method) -> None:
    times = np.sort(np.random.default_rng(5).uniform(0.0, 0.3, 50))
    found = Simulator(oscillator(), Tolerances(1e-8, 1e-9, 1.0), method()).run(np.array([0.4]), times)
    np.testing.assert_allclose(found.theta[:, 0], oscillation(times - times[0], 0.4), rtol=0, atol=1e-6)
    assert found.steps >= 49


def test_a_stuck_arm_is_stepped_over_commands_that_jump() -> None:
    """Dry friction takes up what changes; Newton's method begins where the joints stick, not where they would go."""
    times, random = np.arange(0.0, 1.0, 0.01), np.random.default_rng(2)
    arm = with_dry_friction(prototype_model(5)).with_values({"stribeck_gain": 0.0})
    pulls = Tensions(times, np.column_stack([random.uniform(0, 0.5, times.size), np.zeros(times.size)]), held=True)
    found = Simulator(arm, Tolerances(1e-3, 1e-4, 0.01)).run(np.zeros(5), times, pulls)
    assert np.abs(found.theta).max() < 1e-3
    assert found.refused < times.size / 10
