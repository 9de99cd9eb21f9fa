"""What ideal sensors feel, against the chain's geometry and mechanics that are known without it."""

import numpy as np
import pytest

from continuum.dynamics.model import ActiveEffect
from continuum.dynamics.model_file import load_model
from continuum.effects.base_tilt import BaseTilt
from continuum_hw_imu.emulator.link_motion import along, effective, gravity, link_motion

B = 0.02
G = 9.81


def positions(theta: np.ndarray) -> np.ndarray:
    """Of the sensors, walked along the chain from the base: b to the first joint, b to its sensor, and so on."""
    place, found = np.array([0.0, 0.0, B]), []
    for u in along(np.cumsum(theta)):
        found.append(place + B * u)
        place = place + 2 * B * u
    return np.array(found)


def test_velocities_are_those_of_the_places():
    random = np.random.default_rng(0)
    theta, rate, step = random.normal(0, 0.5, 5), random.normal(0, 2.0, 5), 1e-6
    change = (positions(theta + step * rate) - positions(theta - step * rate)) / (2 * step)
    np.testing.assert_allclose(link_motion(theta, rate, B).velocities, change, atol=1e-8)


@pytest.mark.parametrize("bend", [0.0, 0.3, -0.5])
def test_at_rest_it_feels_gravity_s_opposite_turned_with_the_link(bend):
    at_rest = link_motion(np.array([bend, 0.0]), np.zeros(2), B)
    force = effective(at_rest, at_rest, 0.01, np.array([0.0, 0.0, G]))
    expected = -G * np.array([-np.sin(bend), 0.0, np.cos(bend)])  # positive bends lift the tip towards x
    np.testing.assert_allclose(force, [expected, expected], atol=1e-12)


def test_turning_steadily_it_feels_the_pull_to_the_middle():
    speed, step = 3.0, 1e-4
    before, after = (link_motion(np.array([angle]), np.array([speed]), B) for angle in (0.7, 0.7 + speed * step))
    force = effective(before, after, step, np.zeros(3))
    np.testing.assert_allclose(force, [[0.0, 0.0, -(speed**2) * B]], atol=1e-6)


def test_gravity_is_where_the_model_s_energy_is_least():
    model = load_model("lamecc_prototype.yaml").with_values({"hang_angle": 0.4})
    np.testing.assert_allclose(gravity(model), G * np.array([np.sin(-0.4), 0.0, np.cos(0.4)]))


def test_a_tilted_base_tilts_gravity():
    shipped = load_model("lamecc_prototype.yaml")
    tilted = type(shipped)(shipped.parameters, (ActiveEffect(BaseTilt(), {"angle": np.array([0.1])}),))
    np.testing.assert_allclose(gravity(tilted), G * np.array([-np.sin(0.1), 0.0, np.cos(0.1)]))
