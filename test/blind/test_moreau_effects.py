"""The second plant's hidden effects: each shows at medium size, and fades with its size; laws of some."""

from functools import cache

import numpy as np
import pytest

from blind.moreau import EFFECTS, Machine, make_case
from blind.moreau.loads import carried
from blind.moreau.state import State
from blind.plant import Case, Effect, prototype
from blind.plant.parameters import GRAVITY
from blind.plant.sensors import ORDINARY

pytestmark = pytest.mark.slow

SEED = 3
NOTHING = np.zeros(2)
# as multiples of medium; a winch goes only with the effect as a whole, and a joint that hardly gives before it slips is
# too stiff for the step
FADED = dict.fromkeys(EFFECTS, 0.0005) | {"elastic_cable": 0.0, "presliding": 2e-3}


def measured(regime: str, *effects: str, size: str | float = "medium", seconds: float = 2.0) -> Case:
    return make_case(effects, size, [regime], SEED, seconds=seconds)


@cache
def clean(regime: str, seconds: float = 2.0) -> Case:
    return measured(regime, seconds=seconds)


def change(case: Case, other: Case) -> float:
    """Difference in what is read without noise, root mean square over rows and joints, over the noise's deviation."""
    difference = case.without_noise["run_1.csv"] - other.without_noise["run_1.csv"]
    return float(np.sqrt(np.mean(difference**2)) / ORDINARY.joint_angle())


def arm(*effects: Effect, seed: int = 0) -> Machine:
    return Machine(prototype(), effects, np.random.default_rng(seed))


def stepped(machine: Machine, command: list[float], steps: int) -> list[State]:
    """Copies of the state after each of so many steps."""
    found = []
    for _ in range(steps):
        machine.step(np.array(command))
        found.append(State(*(value.copy() for value in machine.state)))
    return found


@pytest.mark.parametrize("name", EFFECTS)
def test_an_effect_shows_at_medium_size(name: str) -> None:
    regime = "release" if "release" in EFFECTS[name].seen_in else "hold_and_release"
    assert change(measured(regime, name), clean(regime)) > 1.0


@pytest.mark.parametrize("name", EFFECTS)
def test_an_effect_fades_with_its_size(name: str) -> None:
    assert change(measured("chirp", name, size=FADED[name], seconds=0.4), clean("chirp", 0.4)) < 0.2


def test_effects_act_together() -> None:
    both = measured("chirp", "base_compliance", "backlash", seconds=0.4)
    for alone in both.truth.names:
        assert change(both, measured("chirp", alone, seconds=0.4)) > 0.1


def test_an_effect_that_is_not_known_is_refused() -> None:
    class Other(Effect):
        name = "other"

        def build(self, chain: object) -> None:
            """Something."""

    with pytest.raises(ValueError, match="does not know the effect other"):
        arm(Other(1.0))


def test_play_ends_at_its_stops() -> None:
    """To the last digits; free in between, and pressed to one or the other again and again."""
    machine = arm(EFFECTS["backlash"](0.015, 2))
    machine.pull_to(1.5)
    angle = np.array([state.q[machine.chain.link[1]] for state in stepped(machine, [0.0, 0.0], 2400)])
    assert np.ptp(angle) == pytest.approx(0.03)
    assert np.abs(angle).max() < 0.015 + 1e-12


def test_discs_stop_where_their_holes_meet() -> None:
    machine = arm(EFFECTS["joint_stiffness"](-0.95, 3))
    machine.settle(np.array([40.0, 0.0]))
    assert machine.angle[2] == pytest.approx(2 * np.arctan2(0.01925, 0.032), abs=2e-3)


@pytest.mark.parametrize("pull", [0.0, 9.0])
def test_a_joint_carries_the_weight_beyond_less_what_cables_press(pull: float) -> None:
    machine, none = arm(), np.zeros(5)
    weight = GRAVITY * np.cumsum(prototype().mass[::-1])[::-1]
    found = carried(machine.chain, 0.0, none, none, none, np.array([0.0, -GRAVITY]), np.full(5, 2 * pull))
    np.testing.assert_allclose(found, np.abs(weight - 2 * pull))


def test_a_joint_that_swings_carries_what_bends_its_links_path() -> None:
    """All turning as one about the base at w: the sum of m w^2 r upwards, from the hinges on."""
    machine, none, w, b = arm(), np.zeros(5), 3.0, 0.01925
    found = carried(machine.chain, 0.0, none, np.full(5, w), none, NOTHING, none)
    radius = 2 * b * np.arange(5) + b  # the chain's first hinge is joint 1
    np.testing.assert_allclose(found, w**2 * np.cumsum((prototype().mass * radius)[::-1])[::-1])


def test_joints_that_give_come_back_before_they_slip() -> None:
    """So little tension that most elements hold bends the arm, and most of that is gone without it."""
    pull = np.array([0.3, 0.0])
    machine, rigid = arm(EFFECTS["presliding"](0.02)), arm()
    rigid.settle(pull)
    machine.settle(pull, 3.0)
    bent = machine.angle.sum()
    machine.settle(NOTHING, 3.0)
    assert rigid.angle.sum() == 0.0
    assert bent > 0.005
    assert abs(machine.angle.sum()) < 0.3 * bent


def test_a_bracket_bends_by_its_compliance_times_the_torque() -> None:
    """Hanging askew and at rest: weight of all bodies times their distance from the plumb line."""
    machine = arm(EFFECTS["base_tilt"](0.1), EFFECTS["base_compliance"](0.1))
    machine.settle(NOTHING, 10.0)
    turned = np.cumsum(machine.state.q)
    chain = machine.chain
    hinges = np.cumsum(chain.length * np.sin(turned + 0.1)) - chain.length * np.sin(turned + 0.1)
    torque = -GRAVITY * np.sum(chain.mass * (hinges + chain.centre * np.sin(turned + 0.1)))
    assert machine.state.q[0] == pytest.approx(0.1 * torque, rel=1e-3)


def test_what_load_cells_show_is_more_than_what_pulls() -> None:
    machine = arm(EFFECTS["tension_scale"](0.2))
    machine.step(np.array([12.0, 11.0]))
    np.testing.assert_allclose(machine.state.pulling, [10.0, 10.0])


def test_a_lag_begins_at_the_instant_of_the_command() -> None:
    machine = arm(EFFECTS["actuator_lag"](0.02))
    middle = machine.dt * (np.arange(200) + 0.5)
    found = [state.pulling[0] for state in stepped(machine, [12.0, 0.0], 200)]
    np.testing.assert_allclose(found, 12 * (1 - np.exp(-middle / 0.02)), atol=1e-3)


def test_a_sag_is_reeled_in_from_the_instant_of_the_command() -> None:
    machine = arm(EFFECTS["slack_cable"](0.004))
    taut_after = (0.004 - 0.001) / 0.3
    found = [state.pulling[0] for state in stepped(machine, [12.0, 0.0], round(1.2 * taut_after / machine.dt))]
    assert np.flatnonzero(found)[0] == pytest.approx(taut_after / machine.dt, abs=1)


def test_an_elastic_cable_pulls_as_commanded_in_the_end() -> None:
    machine = arm(EFFECTS["elastic_cable"](2e-3))
    machine.settle(np.array([15.0, 0.0]), 0.01)
    assert machine.state.pulling[0] < 10.0
    machine.settle(np.array([15.0, 0.0]), 2.0)
    assert machine.state.pulling[0] == pytest.approx(15.0, rel=1e-3)


def test_a_remounted_base_hangs_otherwise_in_every_recording() -> None:
    turned = np.array([arm(EFFECTS["remounted_base"](0.05), seed=seed).mechanism.base_tilt for seed in range(12)])
    assert np.unique(np.round(turned, 6)).size == 12
    assert np.all((np.abs(turned) > 0.025) & (np.abs(turned) < 0.075))
    assert set(np.sign(turned)) == {-1.0, 1.0}


def test_a_load_falls_off_once() -> None:
    machine = arm(EFFECTS["dropping_load"](0.1))
    assert 0.25 * 1.6 <= machine.mechanism.drop_at <= 0.5 * 1.6
    assert machine.mechanism.dropping == 0.1
