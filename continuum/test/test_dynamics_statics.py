"""Where the arm rests: forces in balance, least energy, losses of the cables, and what dry friction holds."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import (
    Broken,
    LaggingDrive,
    TipLoad,
    TurningBase,
    active,
    moving,
    prototype_model,
    random_model,
)
from effects_laws import effect_of

from continuum.dynamics.balance import balance
from continuum.dynamics.model import Model
from continuum.dynamics.planar.cable_lengths import chord_jacobian, chord_lengths
from continuum.dynamics.planar.cable_torque import cable_torque
from continuum.dynamics.planar.rigid_body import gravity_potential, gravity_torque
from continuum.dynamics.planar.springs_and_friction import spring_potential, spring_torque
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.statics.equilibrium import Equilibrium, EquilibriumStatus, equilibrium
from continuum.dynamics.statics.resting_arm import Load, RestingArm
from continuum.dynamics.statics.sticking_zone import StickingZone, break_away, sticking_zone
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import InvalidValueError

pytestmark = pytest.mark.slow

N = 3
PULL = np.array([8.0, 3.0])


@lru_cache
def compiled(effects: bool) -> RestingArm:
    return RestingArm(model_of(0, effects))


def model_of(seed: int, effects: bool = False) -> Model:
    """Springs stiff enough for one equilibrium near the relaxed arm."""
    added = (
        active(TipLoad(), mass=0.05),
        active(LaggingDrive(), lag=0.1),
        active(TurningBase(), tilt=0.2, frequency=3),
    )
    model = random_model(seed, N, added if effects else ())
    return model.with_values({"stiffness": 2 + model.parameters.stiffness, "gravity": 5.0})


def arm_of(model: Model) -> RestingArm:
    return RestingArm(model, compiled(bool(model.effects)).equations)


def found_at(model: Model, load: Load) -> Equilibrium:
    found = equilibrium(arm_of(model), load)
    assert found.status is EquilibriumStatus.STABLE
    return found


@pytest.mark.parametrize("effects", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_nothing_is_left_of_the_equations(seed: int, effects: bool) -> None:
    model = model_of(seed, effects)
    found = found_at(model, Load(PULL))
    x = np.concatenate([found.theta, np.zeros(N), found.states])
    left = balance(model, x, np.zeros(N + model.n_states), PULL)
    np.testing.assert_allclose(left, 0, atol=1e-9)
    assert np.abs(found.theta).max() > 0.05
    if effects:
        np.testing.assert_allclose(found.states, [2.0, 1.0, 0.0, 0.0], atol=1e-9)  # tensions as they lag, base at rest


@pytest.mark.parametrize("seed", range(4))
def test_an_equilibrium_without_losses_is_a_minimum_of_the_energy(seed: int) -> None:
    model = model_of(seed).with_values({"capstan_friction": 0.0})
    p, random = model.parameters, np.random.default_rng(seed)
    found = found_at(model, Load(PULL))

    def energy(theta: np.ndarray) -> float:
        rest = gravity_potential(np.cumsum(theta), p)[0] + spring_potential(theta, p).sum()
        return float(rest + chord_lengths(theta, p).sum(axis=0) @ PULL)

    for size in (1e-3, 0.1, 0.5):
        around = [energy(found.theta + size * random.normal(size=N)) for _ in range(20)]
        assert min(around) > energy(found.theta)
    np.testing.assert_allclose(found.stiffness, found.stiffness.T, rtol=0, atol=1e-10)


@pytest.mark.parametrize("effects", [False, True])
def test_stiffness_is_the_derivative_of_the_torques(effects: bool) -> None:
    model = model_of(5, effects)
    found = found_at(model, Load(PULL))

    def torques(theta: np.ndarray) -> np.ndarray:
        x = np.concatenate([theta, np.zeros(N), found.states])
        return balance(model, x, np.zeros(N + model.n_states), PULL)[:N]

    np.testing.assert_allclose(found.stiffness, differences(torques, found.theta), rtol=0, atol=1e-8)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("approach", [1, -1])
def test_cables_lose_by_the_direction_of_approach(seed: int, approach: int) -> None:
    """Eq. 15 as printed where cable 1 was taken in, with the other sign where it was paid out."""
    model = model_of(seed).with_values({"rest_angle": 0.1, "gravity": 0.5, "capstan_friction": 0.3})
    p, u = model.parameters, np.array([20.0, 0.0])
    theta = found_at(model, Load(u, approach)).theta
    assert np.all(theta > 0)
    tension = u[0] * np.exp(-approach * p.capstan_friction * (np.cumsum(theta) - theta / 2))
    pull = -tension * chord_jacobian(theta, p)[:, 0]
    np.testing.assert_allclose(gravity_torque(np.cumsum(theta), p) + spring_torque(theta, p), pull, rtol=0, atol=1e-9)


def test_a_standing_arm_too_heavy_for_its_springs_rests_but_not_for_long() -> None:
    model = prototype_model(N).with_values({"hang_angle": np.pi, "stiffness": 0.05})
    found = equilibrium(arm_of(model), Load(np.zeros(2)))
    assert found.status is EquilibriumStatus.UNSTABLE
    np.testing.assert_allclose(found.theta, 0, atol=1e-12)
    stiff = model.with_values({"stiffness": 5.0})
    assert equilibrium(arm_of(stiff), Load(np.zeros(2))).status is EquilibriumStatus.STABLE


def test_the_start_chooses_among_equilibria() -> None:
    """A single heavy link on a weak spring that stands: one upright, one to either side."""
    arm = RestingArm(prototype_model(1).with_values({"hang_angle": np.pi, "stiffness": 0.02}))
    none = Load(np.zeros(2))
    sides = [equilibrium(arm, none, np.array([angle])) for angle in (-2.0, 2.0)]
    assert {side.status for side in sides} == {EquilibriumStatus.STABLE}
    np.testing.assert_allclose(sides[0].theta, -sides[1].theta, atol=1e-9)
    assert sides[1].theta[0] > 1
    assert equilibrium(arm, none, np.zeros(1)).status is EquilibriumStatus.UNSTABLE


def test_springs_relaxed_elsewhere_by_an_effect_lead_to_the_same_equilibrium() -> None:
    """A standing arm that falls to the side to which its springs are bent."""
    bare = prototype_model(5).with_values({"hang_angle": np.pi, "stiffness": 0.3})
    bent = Model(bare.parameters, (active(effect_of("rest_angle"), 5, angle=0.9),))
    found = [
        equilibrium(RestingArm(model), Load(np.zeros(2))) for model in (bare.with_values({"rest_angle": 0.9}), bent)
    ]
    assert found[1].status is found[0].status is EquilibriumStatus.STABLE
    np.testing.assert_allclose(found[1].theta, found[0].theta, rtol=0, atol=1e-9)


def test_no_equilibrium_is_reported() -> None:
    arm = RestingArm(random_model(33, 1, (active(Broken(), limit=-1.0),)))
    found = equilibrium(arm, Load(np.zeros(2)))
    assert found.status is EquilibriumStatus.NOT_FOUND
    assert np.all(np.isnan(found.theta))


STICKY = {"coulomb_friction": [0.04, 0.06, 0.02], "stribeck_gain": [0.7, 0.3, 0.0], "friction_slope": 1e5}
LOADS = [Load(np.zeros(2)), Load(PULL), Load(PULL, 1), Load(np.array([2.0, 9.0]), -1)]


def zone_of(seed: int, load: Load) -> tuple[Model, Equilibrium, StickingZone]:
    model = model_of(seed).with_values(STICKY)
    found = found_at(model, load)
    return model, found, sticking_zone(arm_of(model), found)


def torque_to_hold(model: Model, theta: np.ndarray, load: Load) -> np.ndarray:
    p, bending = model.parameters, moving(theta, np.full(N, 1e9 * load.approach))
    pulled = cable_torque(bending, load.tension, p)
    return gravity_torque(np.cumsum(theta), p) + spring_torque(theta, p) - pulled


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("seed", [7, 8])
def test_at_the_ends_of_the_zone_every_joint_is_about_to_slip(seed: int, load: Load) -> None:
    model, found, zone = zone_of(seed, load)
    held = np.array([0.04 * 1.7, 0.06 * 1.3, 0.02])
    np.testing.assert_allclose(zone.break_away, held, rtol=1e-12)
    for side in range(2):
        for joint, posture in enumerate(zone.postures[side]):
            np.testing.assert_allclose(np.abs(torque_to_hold(model, posture, load)), held, rtol=0, atol=1e-8)
            assert posture[joint] == (zone.lower, zone.upper)[side][joint]
    assert np.all((zone.lower < found.theta) & (found.theta < zone.upper))


@pytest.mark.parametrize("load", LOADS)
def test_the_intervals_hold_every_posture_that_friction_holds_and_no_more(load: Load) -> None:
    """Of postures around the equilibrium, those within break-away torque lie in the intervals and nearly fill them."""
    model, found, zone = zone_of(9, load)
    random = np.random.default_rng(1)
    torques = random.uniform(-1, 1, (4000, N)) * 1.05 * zone.break_away
    torques[:2000] = np.sign(torques[:2000]) * zone.break_away * random.uniform(0.97, 1.0, (2000, N))
    postures = found.theta + np.linalg.solve(found.stiffness, torques.T).T
    held = [q for q in postures if np.all(np.abs(torque_to_hold(model, q, load)) <= zone.break_away)]
    assert len(held) > 1000
    assert np.all((held >= zone.lower - 1e-12) & (held <= zone.upper + 1e-12))
    assert np.all(np.ptp(held, axis=0) > 0.93 * (zone.upper - zone.lower))
    bend = np.sum(held, axis=1)
    assert zone.total_bend[0] <= bend.min() < bend.max() <= zone.total_bend[1]
    assert np.ptp(bend) > 0.93 * np.ptp(zone.total_bend)


@pytest.mark.parametrize("joint", range(N))
def test_within_the_zone_the_arm_stays_and_beyond_it_moves(joint: int) -> None:
    load, model = LOADS[1], model_of(10).with_values(STICKY | {"capstan_friction": 0.0})
    found = found_at(model, load)
    zone, simulator = sticking_zone(arm_of(model), found), Simulator(model)
    times, tensions = np.array([0.0, 0.5]), Tensions(np.zeros(1), load.tension[None])
    for share, moves in ((0.95, False), (1.3, True)):
        start = found.theta + share * (zone.postures[1, joint] - found.theta)
        end = simulator.run(start, times, tensions)
        assert end.status is SimulationStatus.COMPLETE
        assert (np.abs(end.theta[-1] - start).max() > 1e-3) == moves


def test_friction_that_an_effect_changes_counts() -> None:
    model = model_of(11, effects=True)
    np.testing.assert_array_equal(break_away(model), break_away(model_of(11)))
    slippery = model.with_values({"coulomb_friction": 0.0})
    zone = sticking_zone(arm_of(slippery), found_at(slippery, Load(PULL)))
    np.testing.assert_allclose(zone.upper, zone.lower, rtol=0, atol=1e-8)


@pytest.mark.parametrize(
    "wrong",
    [
        {"tension": np.zeros(3)},
        {"tension": [-1.0, 0.0]},
        {"tension": [np.nan, 0.0]},
        {"tension": "x"},
        {"tension": np.zeros(2), "approach": 2},
    ],
)
def test_bad_loads_are_reported(wrong: Mapping[str, object]) -> None:
    with pytest.raises(InvalidValueError, match="allowed"):
        Load(**wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize("start", [np.zeros(2), np.full(3, np.inf), "x"])
def test_bad_starts_are_reported(start: object) -> None:
    with pytest.raises(InvalidValueError, match="start"):
        equilibrium(compiled(False), Load(np.zeros(2)), start)  # type: ignore[arg-type]
