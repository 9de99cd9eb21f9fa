"""The second plant's smooth mechanics by their laws: energy, Lagrange's equations, virtual work, the other plant."""

from itertools import pairwise

import numpy as np
import pytest

from blind import plant
from blind.moreau import Machine
from blind.moreau.cables import lengths, slopes
from blind.moreau.chain import Chain, assemble, energy, equations, gravity
from blind.moreau.mechanism import Mechanism, without_effects
from blind.moreau.outside import add_drag, strap
from blind.plant import Parameters, prototype

pytestmark = pytest.mark.slow

NOTHING = np.zeros(2)
BENT = [20, 10, 25, -5, 30]  # [deg]
H = 1e-6  # of differences [rad]


def frictionless() -> Parameters:
    p = prototype().with_(cable_friction=0.0)
    for name in ("coulomb", "viscous"):
        p = p.scaled(name, None, 0.0)
    return p


def placed(p: Parameters, degrees: list[float], steps: int = 40) -> Machine:
    machine = Machine(p, (), np.random.default_rng(0), steps)
    machine.state.q[:] = np.radians(degrees)
    return machine


def released(p: Parameters, degrees: list[float], steps: int) -> np.ndarray:
    """Angles of the links [rad] from a posture on, for 0.8 s."""
    return placed(p, degrees, steps).record(np.zeros((97, 2))).angle


def error(one: np.ndarray, other: np.ndarray) -> float:
    """Root mean square of the difference, over the range."""
    return float(np.sqrt(np.mean((one - other) ** 2)) / np.ptp(other))


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


@pytest.mark.parametrize(("steps", "bound"), [(40, 2e-3), (160, 1e-4)])
def test_without_friction_energy_stays(steps: int, bound: float) -> None:
    """Over a second it strays by a bounded share of what there is to swing; that falls faster than the step."""
    machine = placed(frictionless(), BENT, steps)
    at = [energy(machine.mechanism, machine.chain, q, np.zeros(5)) for q in (machine.state.q, np.zeros(5))]
    strayed = []
    for _ in range(20):
        machine.settle(NOTHING, 0.05)
        now = energy(machine.mechanism, machine.chain, machine.state.q, machine.state.v)
        strayed.append((now - at[0]) / (at[0] - at[1]))
    assert np.abs(strayed).max() < bound


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


def test_cables_lengths_are_those_of_chords_and_their_torque_that_of_virtual_work() -> None:
    a, b = 0.032, 0.01925
    angle = np.radians([20, -10, 25, 5, 30])
    for side, length in zip((a, -a), lengths(angle, a, b), strict=True):
        before = np.array([side * np.ones(5), b * np.ones(5)])
        after = np.array([side * np.cos(angle) + b * np.sin(angle), side * np.sin(angle) - b * np.cos(angle)])
        assert length == pytest.approx(np.hypot(*(after - before)).sum())
    found = np.array([(lengths(angle + s, a, b) - lengths(angle - s, a, b)) / (2 * H) for s in H * np.eye(5)])
    np.testing.assert_allclose(slopes(angle, a, b), found.T, atol=1e-9)


def test_the_strap_pulls_along_its_line() -> None:
    m, chain = everything()
    m = m._replace(strap=60.0)
    q = np.random.default_rng(2).uniform(-0.5, 0.5, chain.length.size)
    stretch = [strap(m, chain, np.cumsum(q + s))[0] - strap(m, chain, np.cumsum(q - s))[0] for s in H * np.eye(q.size)]
    np.testing.assert_allclose(strap(m, chain, np.cumsum(q))[1], np.array(stretch) / (2 * H), atol=1e-8)


def test_drag_of_a_stiff_arm_that_swings_is_that_of_a_rod() -> None:
    """-c w^2 times the integral of r^3 about the base, straight from b to 11 b."""
    m = without_effects(prototype())._replace(drag=5.0)
    chain, b, w = assemble(m), m.half_spacing, 3.0
    torque = np.zeros(5)
    add_drag(m, chain, np.zeros(5), np.full(5, w), torque)
    assert torque.sum() == pytest.approx(-5.0 * w**2 * (10 * b) ** 4 / 4, rel=1e-3)


def test_where_nothing_rubs_half_the_step_makes_a_quarter_of_the_error() -> None:
    exact = released(frictionless(), BENT, 1280)
    errors = [error(released(frictionless(), BENT, steps), exact) for steps in (40, 80, 160)]
    for coarse, fine in pairwise(errors):
        assert 3 < coarse / fine < 5
    assert errors[0] < 2e-3


def test_where_joints_rub_a_tenth_of_the_step_makes_a_tenth_of_the_error() -> None:
    """On the average of several postures: where within a step a joint comes to rest is by chance."""
    postures = (BENT, [30, 20, 10, 0, -10], [-15, 25, 5, 20, 10], [12] * 5)
    exact = [released(prototype(), posture, 2560) for posture in postures]
    coarse, fine = (
        np.mean([error(released(prototype(), posture, steps), e) for posture, e in zip(postures, exact, strict=True)])
        for steps in (16, 160)
    )
    assert 5 < coarse / fine < 20
    assert coarse < 2e-4


@pytest.mark.parametrize("rubs", [False, True])
def test_the_arm_moves_as_the_other_plants_does(rubs: bool) -> None:
    """Without friction by 0.2 % of the range, which is what MuJoCo's step leaves of its own; with it by 0.002 %.

    The laws of friction agree without Stribeck's term only.
    """
    p = prototype().scaled("stribeck", None, 0.0) if rubs else frictionless()
    other = plant.Machine(p, (), np.random.default_rng(0), 256)
    other.data.qpos[:] = np.radians(BENT)
    assert error(released(p, BENT, 40), other.record(np.zeros((97, 2))).angle) < (2e-5 if rubs else 2e-3)


@pytest.mark.parametrize("regime", ["release", "reversals"])
def test_a_whole_case_without_stribecks_term_is_that_of_the_other_plant(regime: str) -> None:
    """Pulled, held, let go or driven, with the cables' friction: to some hundredths of a degree most of the time."""
    p = prototype().scaled("stribeck", None, 0.0)
    command = plant.COMMANDS["reversals"](np.arange(121) / 120, np.random.default_rng(4))
    found = []
    for machine in (Machine, plant.Machine):
        arm = machine(p, (), np.random.default_rng(0))
        if regime == "release":
            command = np.tile(arm.pull_to(1.2), (121, 1))
            found.append(arm.record(command, let_go_at=3).angle)
        else:
            arm.settle(command[0])
            found.append(arm.record(command).angle)
    assert np.degrees(np.sqrt(np.mean((found[0] - found[1]) ** 2))) < 0.02
    assert np.degrees(np.abs(found[0] - found[1])).max() < 0.1
