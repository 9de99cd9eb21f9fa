"""The dynamic model's posture has the wanted bend, and friction and tensions that hold it."""

import numpy as np
import pytest

from continuum.curvature.held_posture import HeldPosture, held_posture
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.pulled_posture import pulled_posture
from continuum.dynamics.statics.equilibrium import equilibrium
from continuum.dynamics.statics.resting_arm import Load, RestingArm
from continuum.dynamics.statics.sticking_zone import break_away
from continuum.errors import InvalidValueError

pytestmark = pytest.mark.slow

MODEL = load_model("lamecc_prototype.yaml")
BENDS = np.radians([-110.0, -40, 3, 55, 90])


def held(total: float, tension: list[float] | None = None, approach: int = 1, model: Model = MODEL) -> HeldPosture:
    given = None if tension is None else np.array(tension)
    return held_posture(RestingArm(model), total, given, approach)


def missing_torque(found: HeldPosture, model: Model = MODEL) -> np.ndarray:
    """What friction has to hold, (n,) [N m]."""
    return RestingArm(model).pull(found.theta, found.load)[0]


@pytest.mark.parametrize("tension", [None, [20.0, 0.0], [12.0, 5.0], [0.0, 0.0]])
@pytest.mark.parametrize("approach", [1, -1])
@pytest.mark.parametrize("total", BENDS)
def test_the_bend_is_the_wanted_one_and_friction_holds_what_is_left(
    total: float, approach: int, tension: list[float] | None
) -> None:
    found = held(total, tension, approach)
    assert found.theta.sum() == pytest.approx(total, abs=1e-7)
    assert abs(found.friction) <= 1
    np.testing.assert_allclose(missing_torque(found), found.friction * break_away(MODEL), rtol=0, atol=1e-8)
    assert found.load.approach == approach
    assert np.all((found.zone.lower <= found.theta + 1e-9) & (found.theta <= found.zone.upper + 1e-9))


def test_without_a_tension_it_is_the_arm_that_is_pulled_before_a_release() -> None:
    for total in (0.5, -1.2):
        found, pulled = held(total, None, int(np.sign(total))), pulled_posture(MODEL, total)
        np.testing.assert_allclose(found.theta, pulled.theta, rtol=0, atol=1e-7)
        np.testing.assert_allclose(found.load.tension, pulled.tension, rtol=1e-6)


def test_known_tensions_are_kept_as_long_as_friction_holds_the_bend() -> None:
    rests = equilibrium(RestingArm(MODEL), Load(np.array([20.0, 0.0]), 1))
    low, high = held(float(rests.theta.sum()), [20.0, 0.0]).zone.total_bend
    for total in np.linspace(low, high, 7)[1:-1]:
        found = held(float(total), [20.0, 0.0])
        assert found.known is None
        np.testing.assert_array_equal(found.load.tension, [20.0, 0.0])
    for total in (low - 0.02, high + 0.02):
        found = held(float(total), [20.0, 0.0])
        np.testing.assert_allclose(found.known, [low, high], rtol=0, atol=1e-6)
        assert (found.load.tension[0] > 20) == (total > high)
        assert found.friction == 0


def test_both_cables_keep_their_ratio_where_they_are_not_enough() -> None:
    found = held(np.radians(95), [20.0, 5.0])
    assert found.load.tension[0] / found.load.tension[1] == pytest.approx(4)


@pytest.mark.parametrize("tension", [None, [14.0, 2.0]])
@pytest.mark.parametrize("total", BENDS)
def test_a_mirrored_arm_is_held_in_the_mirrored_posture(total: float, tension: list[float] | None) -> None:
    other = None if tension is None else tension[::-1]
    one, mirrored = held(total, tension, 1), held(-total, other, -1)
    np.testing.assert_allclose(mirrored.theta, -one.theta, rtol=0, atol=1e-7)
    np.testing.assert_allclose(mirrored.load.tension, one.load.tension[::-1], rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(mirrored.zone.lower, -one.zone.upper, rtol=0, atol=1e-6)


@pytest.mark.parametrize("tension", [None, [20.0, 0.0]])
def test_the_derivative_is_the_change_with_the_bend(tension: list[float] | None) -> None:
    """Exact where friction changes; where the tension does, to some hundredths, as its lever is not the same at all."""
    total, step = np.radians(80), 1e-4
    change = (held(total + step, tension).theta - held(total - step, tension).theta) / (2 * step)
    np.testing.assert_allclose(held(total, tension).derivative, change, rtol=0, atol=1e-5 if tension else 0.04)


def test_an_arm_without_friction_needs_the_one_tension() -> None:
    slippery = MODEL.with_values({"coulomb_friction": 0.0})
    found = held(1.0, [20.0, 0.0], 1, slippery)
    np.testing.assert_allclose(missing_torque(found, slippery), 0, atol=1e-8)
    assert found.theta.sum() == pytest.approx(1.0, abs=1e-7)


def test_a_bend_that_nothing_holds_is_refused() -> None:
    """A standing arm that falls over to either side."""
    falling = MODEL.with_values({"hang_angle": np.pi, "stiffness": 0.05, "coulomb_friction": 0.0})
    with pytest.raises(InvalidValueError, match="total bend"):
        held(0.2, None, 1, falling)
