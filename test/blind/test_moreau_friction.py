"""The second plant's set-valued laws: exact stiction, no heat from nothing, bounds and velocities that fit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from blind.moreau import Machine
from blind.moreau.boxes import solve_boxed
from blind.moreau.joints import dry_friction
from blind.moreau.mechanism import without_effects
from blind.moreau.state import CABLES, STOPS
from blind.plant import EFFECTS, Effect, prototype
from blind.plant.parameters import GRAVITY

pytestmark = pytest.mark.slow

NOTHING = np.zeros(2)


def arm(*effects: Effect, seed: int = 0) -> Machine:
    return Machine(prototype(), effects, np.random.default_rng(seed))


@pytest.mark.parametrize(("share", "moves"), [(0.999, False), (1.001, True)])
def test_a_joint_breaks_away_at_coulomb_and_stribeck_together(share: float, moves: bool) -> None:
    """Below it the joint does not move by a single digit, above it does."""
    p = prototype()
    gravity = p.mass[4] * GRAVITY * p.half_spacing
    spring = p.coulomb[4] * (1 + p.stribeck[4])
    angle = share * spring / (p.stiffness[4] + gravity)
    machine = arm()
    machine.state.q[4] = angle
    machine.settle(NOTHING)
    assert (machine.state.q[4] != angle) == moves
    assert np.all(machine.state.q[:4] == 0.0) or moves


def test_a_pulled_arm_stands_still_to_the_last_digit_while_tension_changes_little() -> None:
    machine = arm()
    command = machine.pull_to(np.radians(60))
    before = machine.state.q.copy()
    assert np.all(machine.state.v == 0.0)
    machine.settle(0.97 * command)
    assert np.all(machine.state.v == 0.0)
    assert np.all(machine.state.q == before)
    machine.settle(0.3 * command)
    assert np.abs(np.degrees(machine.state.q - before)).max() > 2


@pytest.mark.parametrize(
    "effects",
    [(), *[(EFFECTS[name](EFFECTS[name].sizes[1], 3 if EFFECTS[name].at_a_joint else None),) for name in
           ("backlash", "sensor_cable", "load_friction", "rubbing_disc", "capstan", "base_compliance")]],
    ids=lambda effects: effects[0].name if effects else "none",
)  # fmt: skip
def test_no_law_gives_energy_in_any_step_and_all_are_kept(effects: tuple[Effect, ...]) -> None:
    machine = arm(*effects)
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
    machine = arm()
    for speed, share in ((0.0, 1.0), (1.0, 0.5), (-3.0, 0.1)):
        dry = dry_friction(m, machine.chain, speed * m.stribeck_rate, np.zeros(5))
        np.testing.assert_allclose(dry, m.coulomb * (1 + share * m.stribeck))


def test_a_sliding_cable_loses_tension_as_a_belt_does() -> None:
    """T exp(-mu_c phi), all the way to the middle of each module, where the arm is bent ever more."""
    machine = arm()
    pull = np.zeros(2)
    while machine.angle.sum() < np.radians(80):
        pull[0] += 60.0 * machine.dt
        machine.step(pull)
    friction = machine.state.impulse[CABLES:STOPS].reshape(2, 5)[0] / machine.dt
    turned = np.cumsum(machine.angle) - machine.angle / 2
    np.testing.assert_allclose(1 - np.cumsum(friction) / pull[0], np.exp(-0.2 * turned), rtol=1e-3)


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
