"""Both plants' mechanics: they agree where their laws do; stiction, Lagrange's equations, no heat from nothing."""

from types import ModuleType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from blind import moreau_plant, mujoco_plant
from blind.moreau_plant.boxes import solve_boxed
from blind.moreau_plant.chain import Chain, assemble, equations, gravity
from blind.moreau_plant.joints import dry_friction
from blind.moreau_plant.mechanism import Mechanism, without_effects
from blind.mujoco_plant import EFFECTS, Effect, Parameters, prototype
from blind.mujoco_plant.parameters import GRAVITY

pytestmark = pytest.mark.slow

each_plant = pytest.mark.parametrize("of", [mujoco_plant, moreau_plant], ids=lambda of: of.__name__)

NOTHING = np.zeros(2)
BENT = [20, 10, 25, -5, 30]  # [deg]
H = 1e-6  # of differences [rad]


def made(of: ModuleType, p: Parameters, *effects: Effect, steps: int) -> mujoco_plant.Machine | moreau_plant.Machine:
    return of.Machine(p, effects, np.random.default_rng(0), steps)


def angles(machine: mujoco_plant.Machine | moreau_plant.Machine) -> np.ndarray:
    """Joint angles (5,) [rad], which can be set."""
    return machine.data.qpos if isinstance(machine, mujoco_plant.Machine) else machine.state.q


def frictionless() -> Parameters:
    p = prototype().with_(cable_friction=0.0)
    for name in ("coulomb", "viscous"):
        p = p.scaled(name, None, 0.0)
    return p


def released(of: ModuleType, p: Parameters, steps: int) -> np.ndarray:
    """Angles of the links [rad] from a posture on, for 0.8 s."""
    machine = made(of, p, steps=steps)
    angles(machine)[:] = np.radians(BENT)
    return machine.record(np.zeros((97, 2))).angle


@pytest.mark.parametrize("rubs", [False, True])
def test_the_arm_moves_alike_in_both_plants(rubs: bool) -> None:
    """Without friction by 0.2 % of the range, which is what MuJoCo's step leaves of its own; with it by 0.002 %.

    The laws of friction agree without Stribeck's term only.
    """
    p = prototype().scaled("stribeck", None, 0.0) if rubs else frictionless().with_(base_tilt=0.1)
    one, other = released(moreau_plant, p, 40), released(mujoco_plant, p, 256)
    assert np.sqrt(np.mean((one - other) ** 2)) / np.ptp(other) < (2e-5 if rubs else 2e-3)


@pytest.mark.parametrize("regime", ["release", "reversals"])
def test_a_whole_case_without_stribecks_term_is_alike_in_both_plants(regime: str) -> None:
    """Pulled, held, let go or driven, with the cables' friction: to some hundredths of a degree most of the time."""
    p = prototype().scaled("stribeck", None, 0.0)
    command = mujoco_plant.COMMANDS["reversals"](np.arange(121) / 120, np.random.default_rng(4))
    found = []
    for of in (moreau_plant, mujoco_plant):
        arm = of.Machine(p, (), np.random.default_rng(0))
        if regime == "release":
            command = np.tile(arm.pull_to(1.2), (121, 1))
            found.append(arm.record(command, let_go_at=3).angle)
        else:
            arm.settle(command[0])
            found.append(arm.record(command).angle)
    assert np.degrees(np.sqrt(np.mean((found[0] - found[1]) ** 2))) < 0.02
    assert np.degrees(np.abs(found[0] - found[1])).max() < 0.1


@pytest.mark.parametrize(
    ("of", "steps", "near"), [(mujoco_plant, 64, 0.04), (moreau_plant, 40, 0.001)], ids=["mujoco", "moreau"]
)
@pytest.mark.parametrize("moves", [False, True])
def test_a_joint_breaks_away_at_coulomb_and_stribeck_together(
    of: ModuleType, steps: int, near: float, moves: bool
) -> None:
    p = prototype()
    held = p.coulomb[4] * (1 + p.stribeck[4]) / (p.stiffness[4] + p.mass[4] * GRAVITY * p.half_spacing)
    start = held * (1 + near if moves else 1 - near)
    machine = made(of, p, steps=steps)
    angles(machine)[4] = start
    machine.settle(NOTHING)
    assert (np.degrees(angles(machine)[4]) < np.degrees(start) - 1e-3) == moves


@pytest.mark.parametrize(
    ("of", "steps", "creeps"), [(mujoco_plant, 64, 2e-3), (moreau_plant, 40, 0.0)], ids=["mujoco", "moreau"]
)
def test_a_pulled_arm_stands_still_while_tension_changes_little(of: ModuleType, steps: int, creeps: float) -> None:
    """In the second plant to the last digit."""
    machine = made(of, prototype(), steps=steps)
    command = machine.pull_to(np.radians(60))
    before = angles(machine).copy()
    machine.settle(0.97 * command)
    assert np.abs(np.degrees(angles(machine) - before)).max() <= creeps
    machine.settle(0.3 * command)
    assert np.abs(np.degrees(angles(machine) - before)).max() > 2


@pytest.mark.parametrize("pull", [0.0, 9.0])
def test_a_loaded_joint_rubs_by_what_it_carries(pull: float) -> None:
    """Straight and still, between two cables: the weight beyond the joint less what both cables press it together."""
    p = prototype()
    machine = made(mujoco_plant, p, EFFECTS["load_friction"](1e-3), steps=64)
    for _ in range(3):
        machine.step(np.full(2, pull))
    weight = GRAVITY * np.cumsum(p.mass[::-1])[::-1]
    grown = machine.coulomb - p.coulomb * (1 + p.stribeck)
    assert grown == pytest.approx(1e-3 * np.abs(weight - 2 * pull), rel=1e-3)


def everything() -> tuple[Mechanism, Chain]:
    """An arm whose base gives way, with play at two joints and a load: 8 hinges."""
    m = without_effects(prototype().with_(base_tilt=0.1))
    m = m._replace(base_compliance=0.1, load=0.1).at("clearance", 1, 0.02).at("clearance", 4, 0.02)
    return m, assemble(m)


def places(m: Mechanism, chain: Chain, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Masses (n,) [kg] and where their centres are (n, 2) [m]."""
    turned = np.cumsum(q)
    along = np.column_stack([np.sin(turned), -np.cos(turned)])
    hinges = np.vstack([np.zeros(2), np.cumsum(chain.length[:, None] * along, axis=0)[:-1]])
    mass = chain.mass.copy()
    mass[-1] += m.load
    return mass, hinges + chain.centre[:, None] * along


def test_torques_and_mass_matrix_are_those_of_lagrange() -> None:
    """Of the potential's slope and of the speeds of all centres, each by differences; centrifugal terms by M's."""
    m, chain = everything()
    rng = np.random.default_rng(1)
    n = chain.length.size
    q, v = rng.uniform(-0.5, 0.5, n), rng.uniform(-3, 3, n)

    def matrix(at: np.ndarray) -> np.ndarray:
        steps = H * np.eye(n)
        mass = places(m, chain, at)[0]
        slope = np.array([(places(m, chain, at + s)[1] - places(m, chain, at - s)[1]) / (2 * H) for s in steps])
        turning = np.tril(np.ones((n, n)))
        return np.einsum("ikx,jkx,k->ij", slope, slope, mass) + turning.T @ np.diag(chain.inertia) @ turning

    def potential(at: np.ndarray) -> float:
        mass, where = places(m, chain, at)
        return -float(mass @ where @ gravity(m, 0.0))

    mass, torque = np.empty((n, n)), np.empty(n)
    equations(chain, m.load, np.cumsum(q), np.cumsum(v), gravity(m, 0.0), mass, torque)
    np.testing.assert_allclose(mass, matrix(q), atol=1e-9)

    step = 1e-5
    by_angle = np.array([(matrix(q + s) - matrix(q - s)) / (2 * step) for s in step * np.eye(n)])
    centrifugal = np.einsum("kij,k,j->i", by_angle, v, v) - 0.5 * np.einsum("ijk,j,k->i", by_angle, v, v)
    weight = [-(potential(q + s) - potential(q - s)) / (2 * H) for s in H * np.eye(n)]
    np.testing.assert_allclose(torque, weight - centrifugal, atol=1e-5)


@pytest.mark.parametrize(
    "effects",
    [(), *[(EFFECTS[name](EFFECTS[name].sizes[1], 3 if EFFECTS[name].at_a_joint else None),) for name in
           ("backlash", "sensor_cable", "load_friction", "rubbing_disc", "capstan", "base_compliance")]],
    ids=lambda effects: effects[0].name if effects else "none",
)  # fmt: skip
def test_no_law_gives_energy_in_any_step_and_all_are_kept(effects: tuple[Effect, ...]) -> None:
    machine = made(moreau_plant, prototype(), *effects, steps=40)
    machine.pull_to(1.0)
    for pull in (np.array([25.0, 3.0]), NOTHING, np.array([0.0, 20.0])):
        for _ in range(1200):
            before = machine.state.rubbed[0]
            machine.step(pull)
            assert machine.state.rubbed[0] >= before - 1e-15
    assert machine.state.rubbed[0] > 0.05
    assert machine.state.unsolved[0] == 0


def test_a_joint_at_the_speed_of_stribeck_has_half_of_its_excess() -> None:
    m = without_effects(prototype())
    for speed, share in ((0.0, 1.0), (1.0, 0.5), (-3.0, 0.1)):
        dry = dry_friction(m, assemble(m), speed * m.stribeck_rate, np.zeros(5))
        np.testing.assert_allclose(dry, m.coulomb * (1 + share * m.stribeck))


@given(
    hnp.arrays(float, (9, 5), elements=st.floats(-1, 1).map(lambda x: round(x, 2))),
    hnp.arrays(float, 9, elements=st.floats(-1, 1)),
    hnp.arrays(float, 9, elements=st.floats(0.01, 2)),
)
def test_impulses_are_within_bounds_and_velocities_fit_them(
    direction: np.ndarray, free: np.ndarray, most: np.ndarray
) -> None:
    """Nine rows of five bodies, so that some depend on others; two push to one side only."""
    mixed = direction @ direction.T + np.diag([0.1] * 5 + [0.0] * 4)
    low, high = -most, most.copy()
    low[:2], high[:2] = 0.0, np.inf
    free = mixed @ np.linspace(-1, 1, 9) + np.where(np.arange(9) < 5, free, 0.0)  # within what the rows can do
    p = np.clip(np.zeros(9), low, high)
    assert solve_boxed(mixed, free, low, high, p, 1e-7)
    velocity = free + mixed @ p
    assert np.all((low <= p) & (p <= high))
    assert np.all((velocity < 1e-6) | (p == low))
    assert np.all((velocity > -1e-6) | (p == high))
