"""Effects beyond Eq. 12: each hook does what it says, effects compose, and at their defaults they are absent."""

import numpy as np
import pytest
from dynamics_laws import (
    LaggingDrive,
    TipLoad,
    TurningBase,
    Wind,
    active,
    random_model,
)

from continuum.dynamics.balance import balance
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.values import parameter_slots, parameter_vector
from continuum.errors import InvalidValueError

N = 3
U = np.array([2.0, 1.0])


def instant(seed: int, n_states: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """State and rates; the effects' states follow."""
    random = np.random.default_rng(seed)
    return random.uniform(-0.5, 0.5, 2 * N + n_states), random.normal(size=N + n_states)


def with_effects(*effects: ActiveEffect) -> Model:
    return random_model(41, N, effects)


PLAIN = with_effects()


def test_effects_compose() -> None:
    """Each has its own states and values; together they do what they do alone, whatever their order."""
    effects = [
        active(TurningBase(), tilt=0.2, frequency=3.0),
        active(TipLoad(), mass=0.2),
        active(LaggingDrive(), lag=0.1),
        active(Wind(), N, torque=-0.1),
    ]
    x, v = instant(8, 4)
    x, v = np.abs(x), v  # tensions of the drive are none below zero
    one = balance(with_effects(*effects), x, v, U)
    swap_x, swap_v = np.r_[0 : 2 * N, 2 * N + 2, 2 * N + 3, 2 * N, 2 * N + 1], np.r_[0:N, N + 2, N + 3, N, N + 1]
    other = balance(with_effects(*effects[::-1]), x[swap_x], v[swap_v], U)
    np.testing.assert_allclose(other, one[swap_v], rtol=1e-12)
    np.testing.assert_allclose(one[N : N + 2], [v[N] - x[2 * N + 1], v[N + 1] + 9.0 * x[2 * N]], rtol=1e-12)
    np.testing.assert_allclose(one[N + 2 :], 0.1 * v[N + 2 :] + x[2 * N + 2 :] - U, rtol=1e-12)


def test_a_drive_without_lag_is_an_equation_without_rates_of_its_own() -> None:
    """At the default lag, the state's equation has no rate: the matrix is singular, which is reported."""
    found = Simulator(with_effects(active(LaggingDrive()))).run(
        np.append(np.zeros(2 * N), U), [0.0, 0.1], Tensions([0.0], [U])
    )
    assert not found.status.value.startswith("complete")


def test_names_of_values() -> None:
    model = with_effects(active(TipLoad(), mass=0.1), active(Wind(), N, torque=0.2))
    assert list(model.values())[-2:] == ["tip_load.mass", "wind.torque"]
    assert list(model.values()) == list(model.meanings()) == list(parameter_slots(model))
    assert parameter_vector(model).size == parameter_slots(model)["wind.torque"].stop
    changed = model.with_values({"tip_load.mass": 0.5, "stiffness": 1.0})
    assert changed.values()["tip_load.mass"] == [0.5]
    np.testing.assert_array_equal(changed.parameters.stiffness, np.ones(N))
    assert model.values()["tip_load.mass"] == [0.1]
    x, v = instant(9)
    mass = model.parameters.mass + np.array([0.0, 0.0, 0.5])
    np.testing.assert_allclose(
        balance(changed, x, v, U),
        balance(PLAIN.with_values({"mass": mass, "stiffness": 1.0}), x, v, U) + 0.2,
        rtol=1e-13,
    )


@pytest.mark.parametrize(
    "changed",
    [
        {"stifness": 1.0},
        {"wind.torque": 0.1},
        {"stiffness": -1.0},
        {"stiffness": [1.0, 2.0]},
        {"stiffness": True},
        {"stiffness": np.complex128(1j)},
        {"stiffness": 10**400},
        {"gravity": [9.81, 9.81, 9.81]},
        {"mass": np.nan},
        {"hang_angle": 4.0},
    ],
)
def test_bad_values_are_reported(changed: dict[str, object]) -> None:
    with pytest.raises(InvalidValueError, match="allowed"):
        PLAIN.with_values(changed)


@pytest.mark.parametrize("value", [1.0, 1, np.float32(1.0), np.int64(1), np.array(1.0), [1.0], (1, 1.0, 1), np.ones(N)])
def test_numbers_of_every_kind_are_taken(value: object) -> None:
    np.testing.assert_array_equal(PLAIN.with_values({"stiffness": value}).parameters.stiffness, np.ones(N))


def test_models_do_not_share_their_arrays() -> None:
    given = np.ones(N)
    model = PLAIN.with_values({"stiffness": given})
    given[0] = 7.0
    np.testing.assert_array_equal(model.parameters.stiffness, np.ones(N))
