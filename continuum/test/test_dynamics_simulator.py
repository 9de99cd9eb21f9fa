"""The fast simulator against SciPy's integrators and differences of its own runs; its input and its failures."""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import Broken, LaggingDrive, TurningBase, accelerations, active, prototype_model, random_model
from scipy.integrate import solve_ivp

from continuum.dynamics.effect import Effect, EffectParams
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.integration.esdirk import integrate
from continuum.dynamics.integration.esdirk_tableau import fourth_order, third_order
from continuum.dynamics.integration.scipy_bdf import simulate_bdf
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.planar.instant import Instant
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus
from continuum.dynamics.values import parameter_slots, parameter_vector, shared_directions
from continuum.errors import InvalidValueError

pytestmark = pytest.mark.slow

TIGHT = Tolerances(1e-9, 1e-10, 0.05)
PULLS = Tensions(np.array([0.0, 0.03, 0.11]), np.array([[2.0, 12.0], [15.0, 2.0], [5.0, 5.0]]))


@lru_cache
def two_joints() -> Simulator:
    return Simulator(random_model(31, 2), TIGHT, fourth_order())


@lru_cache
def with_states() -> Simulator:
    """Two joints on a base that swings, pulled by a drive that lags."""
    effects = (active(TurningBase(), tilt=0.1, frequency=20.0), active(LaggingDrive(), lag=0.03))
    return Simulator(random_model(32, 2, effects), TIGHT, fourth_order())


def start(simulator: Simulator) -> np.ndarray:
    return np.concatenate([[0.2, -0.3, 1.0, 2.0], np.linspace(0.3, 1.0, simulator.model.n_states)])


@pytest.mark.parametrize("simulator", [two_joints, with_states])
def test_trajectories_are_those_of_scipy(simulator: object) -> None:
    fast = simulator()  # type: ignore[operator]
    n, times, x0 = 2, np.linspace(0.0, 0.12, 13), start(fast)

    def rates(t: float, x: np.ndarray) -> np.ndarray:
        return np.concatenate([x[n : 2 * n], accelerations(fast.model, x, PULLS.at(t))])

    reference = solve_ivp(rates, (0.0, 0.12), x0, "Radau", times, rtol=1e-7, atol=1e-8, max_step=0.005)
    found = fast.run(x0, times, PULLS)
    assert found.status is SimulationStatus.COMPLETE
    assert np.ptp(found.theta, axis=0).min() > 0.1
    np.testing.assert_allclose(found.states, reference.y.T, rtol=0, atol=1e-5)


@pytest.mark.parametrize("method", [third_order, fourth_order])
def test_the_prototypes_release_at_the_theses_tolerances(method: object) -> None:
    """Close to a converged solution, by both integrators of the library [rad]."""
    model, times = prototype_model(), np.linspace(0.0, 1.6, 81)
    x0 = np.full(5, np.radians(15.0))
    exact = Simulator(model, Tolerances(1e-7, 1e-8, 0.01), fourth_order()).run(x0, times)
    fast = Simulator(model, tableau=method()).run(x0, times)  # type: ignore[operator]
    bdf = simulate_bdf(model, x0, times, equations=Simulator(model).equations)
    for found in (fast, bdf):
        assert found.status is SimulationStatus.COMPLETE
        assert np.degrees(np.abs(found.theta - exact.theta).max()) < 0.05


@pytest.mark.parametrize("simulator", [two_joints, with_states])
@pytest.mark.parametrize("method", [third_order, fourth_order])
def test_derivatives_by_every_parameter_and_by_the_initial_state_are_those_of_runs_nearby(
    simulator: object, method: object
) -> None:
    """Without an estimate of the error all runs take the same steps, so that their differences are smooth."""
    model, x0 = simulator().model, start(simulator())  # type: ignore[operator]
    blind = replace(method(), error=np.zeros_like(method().error))  # type: ignore[operator]
    fast, times, p = Simulator(model, Tolerances(1e-11, 1e-11, 5e-4), blind), [0.0, 0.02, 0.05], parameter_vector(model)
    n, size = p.size, p.size + x0.size
    free, free_initial = np.eye(n, size), np.eye(x0.size, size, k=n)
    found = fast.run(x0, times, PULLS, free=free, free_initial=free_initial).sensitivities
    units = np.concatenate([1e-4 * np.abs(p), np.full(x0.size, 1e-5)])  # no stage moves over a kink of Eq. 15's wrap

    def moved(s: np.ndarray) -> np.ndarray:
        return fast.run(x0 + (s * units)[n:], times, PULLS, p + (s * units)[:n]).states

    expected = differences(moved, np.zeros(size), 1.0) / units
    scale = np.abs(expected).max(axis=(0, 1)) + 1e-3
    assert np.max(np.abs(found - expected) / scale) < 2e-6
    np.testing.assert_array_equal(found[0], free_initial)


def test_derivatives_do_not_depend_on_the_steps() -> None:
    """Those of the adaptive steps are, within its tolerance, those of much finer ones."""
    model, times, x0 = two_joints().model, [0.0, 0.05], start(two_joints())
    free = shared_directions(model, ["stiffness", "viscous_friction", "mass", "half_spacing"])
    fine, coarse = (
        Simulator(model, Tolerances(relative, relative / 10, 0.01)).run(x0, times, PULLS, free=free).sensitivities[-1]
        for relative in (1e-8, 1e-4)
    )
    scale = np.abs(fine).max(axis=0)
    np.testing.assert_allclose(coarse / scale, fine / scale, rtol=0, atol=0.02)


@pytest.mark.parametrize("at", [-3.0, 100.0, 1.7e9])
def test_states_do_not_depend_on_when_the_clock_started(at: float) -> None:
    """Nothing in the equations knows the time; 1.7e9 s is the age of a clock that counts from 1970."""
    fast, x0, times = two_joints(), start(two_joints()), np.linspace(0.0, 0.15, 4)
    found = fast.run(x0, at + times, Tensions(at + PULLS.times, PULLS.values))
    assert found.status is SimulationStatus.COMPLETE
    np.testing.assert_allclose(found.states, fast.run(x0, times, PULLS).states, rtol=0, atol=1e-6 + 5e-4 * (at > 1e6))


def test_a_short_pull_is_not_stepped_over() -> None:
    """10 N for 1 ms within a long rest, at the thesis's tolerances."""
    model = prototype_model(2)
    pulse = Tensions(
        np.array([0.5, 0.5005, 0.501, 0.5015]), np.array([[0.0, 0.0], [80.0, 0.0], [80.0, 0.0], [0.0, 0.0]])
    )
    times = np.array([0.0, 0.52])
    exact = Simulator(model, Tolerances(1e-8, 1e-9, 1e-4)).run(np.zeros(2), times, pulse).states[-1]
    found = Simulator(model).run(np.zeros(2), times, pulse).states[-1]
    assert np.abs(exact).max() > 1e-2
    np.testing.assert_allclose(found, exact, rtol=0, atol=0.05 * np.abs(exact).max())


@pytest.mark.parametrize("gap", [0.0, 5e-17, 1e-13, -1e-13, 1e-11])
def test_tensions_that_bend_or_jump_next_to_an_output_are_met(gap: float) -> None:
    """As 3 * 0.1 and 0.3 do, which are two numbers."""
    fast, x0, times = two_joints(), start(two_joints()), np.linspace(0.0, 0.15, 4)
    steady = Tensions(np.zeros(1), np.array([[9.0, 2.0]]))
    half = fast.run(x0, times[:3], steady)
    expected = fast.run(half.states[-1], times[2:], Tensions(np.zeros(1), np.array([[1.0, 8.0]]))).states[-1]
    at = times[2] + gap
    jump = Tensions(np.array([0.0, at, at + 1e-13]), np.array([[9.0, 2.0], [9.0, 2.0], [1.0, 8.0]]))
    found = fast.run(x0, times, jump)
    assert found.status is SimulationStatus.COMPLETE
    np.testing.assert_allclose(found.states[:3], half.states, rtol=0, atol=1e-7)
    np.testing.assert_allclose(found.states[-1], expected, rtol=0, atol=1e-6)


def test_strided_and_read_only_arrays_are_taken_as_they_are() -> None:
    """Without compiling the integrator for each kind of array, which takes as long as everything else here."""
    fast, x0, times = two_joints(), start(two_joints()), np.linspace(0.0, 0.15, 31)
    expected = fast.run(x0, times[::3].copy(), PULLS)
    compiled = len(integrate.signatures)
    frozen = np.repeat(x0, 2)[::2]
    frozen.flags.writeable = False
    swapped = Tensions(np.repeat(PULLS.times, 2)[::2], PULLS.values[:, ::-1][:, ::-1])
    values = np.repeat(parameter_vector(fast.model), 2)[::2]
    found = fast.run(frozen, times[::3], swapped, values)
    np.testing.assert_array_equal(found.states, expected.states)
    assert len(integrate.signatures) == compiled


def test_one_time_gives_the_initial_state() -> None:
    found = two_joints().run(np.array([0.1, 0.2]), np.array([3.0]))
    np.testing.assert_array_equal(found.states, [[0.1, 0.2, 0.0, 0.0]])
    assert found.status is SimulationStatus.COMPLETE


class Explosion(Effect):
    """A state that is infinite after one second: z' = z^2, z = 1 at the start."""

    name = "explosion"

    def n_states(self, n_joints: int) -> int:
        """One."""
        return 1

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        """As above."""
        return state_rate - state**2


@pytest.mark.parametrize(
    ("limit", "expected"), [(-1.0, [SimulationStatus.NOT_FINITE]), (0.01, list(SimulationStatus)[1:])]
)
def test_a_torque_that_is_no_number_ends_a_simulation(limit: float, expected: list[SimulationStatus]) -> None:
    model = random_model(33, 1, (active(Broken(), limit=limit),))
    found = Simulator(model).run(np.array([0.0, 3.0]), np.linspace(0.0, 1.0, 11))
    assert found.status in expected


def test_a_model_that_cannot_move_ends_a_simulation_with_scipy_too() -> None:
    massless = prototype_model(2).with_values({"inertia": 0.0, "center_of_mass": 0.0})
    found = simulate_bdf(massless, np.full(2, 0.1), np.array([0.0, 0.1]), equations=Simulator(massless).equations)
    assert found.status is SimulationStatus.NOT_FINITE
    assert np.all(np.isnan(found.states))


def test_a_state_that_runs_away_ends_a_simulation() -> None:
    model = random_model(34, 1, (active(Explosion()),))
    fast = Simulator(model, Tolerances(1e-8, 1e-9, 0.1), fourth_order())
    x0 = np.array([0.0, 0.0, 1.0])
    np.testing.assert_allclose(fast.run(x0, np.array([0.0, 0.5, 0.9])).states[:, 2], [1.0, 2.0, 10.0], rtol=1e-5)
    assert fast.run(x0, np.array([0.0, 2.0])).status is not SimulationStatus.COMPLETE


@pytest.mark.parametrize("name", ["stiffness", "mass", "gravity"])
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_values_that_are_no_numbers_never_give_a_trajectory(name: str, bad: float) -> None:
    fast = two_joints()
    values = parameter_vector(fast.model)
    values[parameter_slots(fast.model)[name]] = bad
    try:
        found = fast.run(start(fast), np.array([0.0, 0.1]), values=values)
    except InvalidValueError:
        return
    assert found.status is not SimulationStatus.COMPLETE


@pytest.mark.parametrize(
    "wrong",
    [
        {"initial": np.zeros(3)},
        {"initial": [0.0, np.nan]},
        {"times": np.zeros(0)},
        {"times": np.array([0.0, 0.0])},
        {"times": np.array([1.0, 0.0])},
        {"times": np.array([0.0, np.nan])},
        {"values": np.ones(3)},
        {"free": np.zeros((3, 1))},
        {"free_initial": np.zeros((4, 2))},
    ],
)
def test_bad_input_is_reported(wrong: Mapping[str, object]) -> None:
    right = {"initial": np.zeros(2), "times": np.array([0.0, 0.1])}
    with pytest.raises(InvalidValueError, match="allowed"):
        two_joints().run(**(right | wrong))  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["relative", "absolute", "max_step"])
@pytest.mark.parametrize("bad", [0.0, np.nan])
def test_bad_tolerances_are_reported(name: str, bad: float) -> None:
    with pytest.raises(InvalidValueError, match=name):
        Tolerances(**{name: bad})
