"""Hidden effects of both plants: each shows at medium size, and fades with its size; laws of some."""

from functools import cache
from types import ModuleType

import numpy as np
import pytest

from blind import moreau_plant, mujoco_plant
from blind.moreau_plant.loads import carried
from blind.mujoco_plant import EFFECTS, Case, Effect, prototype
from blind.mujoco_plant.chain import BALL_INERTIA, BALL_MASS, without_ball
from blind.mujoco_plant.parameters import GRAVITY
from blind.mujoco_plant.sensors import ORDINARY

pytestmark = pytest.mark.slow

each_plant = pytest.mark.parametrize("of", [mujoco_plant, moreau_plant], ids=lambda of: of.__name__)

SEED = 3
NOTHING = np.zeros(2)
SECONDS = {mujoco_plant: 1.0, moreau_plant: 2.0}
# as multiples of medium; a winch and a ring of fixed size go only with the effect as a whole, and a joint that hardly
# gives before it slips is too stiff for the step
FADED = dict.fromkeys(EFFECTS, 0.0005) | {"elastic_cable": 0.0, "presliding": 2e-3}
FADED_IN_MUJOCO = FADED | {"backlash": 0.0}


def measured(of: ModuleType, regime: str, *effects: str, size: str | float = "medium", seconds: float) -> Case:
    return of.make_case(effects, size, [regime], SEED, seconds=seconds)


@cache
def clean(of: ModuleType, regime: str, seconds: float) -> Case:
    return measured(of, regime, seconds=seconds)


def change(case: Case, other: Case) -> float:
    """Difference in what is read without noise, root mean square over rows and joints, over the noise's deviation."""
    difference = case.without_noise["run_1.csv"] - other.without_noise["run_1.csv"]
    return float(np.sqrt(np.mean(difference**2)) / ORDINARY.joint_angle())


def arm(*effects: Effect, of: ModuleType = moreau_plant, seed: int = 0) -> mujoco_plant.Machine | moreau_plant.Machine:
    return of.Machine(prototype(), effects, np.random.default_rng(seed))


def pulling(machine: mujoco_plant.Machine | moreau_plant.Machine) -> np.ndarray:
    """Tensions at the base (2,) [N]."""
    of_it: np.ndarray = machine.pulling if isinstance(machine, mujoco_plant.Machine) else machine.state.pulling
    return of_it.copy()


def pulled(machine: mujoco_plant.Machine | moreau_plant.Machine, command: list[float], steps: int) -> np.ndarray:
    """Tension of the first cable [N] at so many instants."""
    found = []
    for _ in range(steps):
        machine.step(np.array(command))
        found.append(pulling(machine)[0])
    return np.array(found)


@each_plant
@pytest.mark.parametrize("name", EFFECTS)
def test_an_effect_shows_at_medium_size(of: ModuleType, name: str) -> None:
    regime = "release" if "release" in EFFECTS[name].seen_in else "hold_and_release"
    assert change(measured(of, regime, name, seconds=SECONDS[of]), clean(of, regime, SECONDS[of])) > 1.0


@each_plant
@pytest.mark.parametrize("name", EFFECTS)
def test_an_effect_fades_with_its_size(of: ModuleType, name: str) -> None:
    size = (FADED_IN_MUJOCO if of is mujoco_plant else FADED)[name]
    assert change(measured(of, "chirp", name, size=size, seconds=0.4), clean(of, "chirp", 0.4)) < 0.2


@each_plant
def test_effects_act_together(of: ModuleType) -> None:
    both = measured(of, "chirp", "base_compliance", "backlash", seconds=0.4)
    assert both.truth.names == ("base_compliance", "backlash")
    for alone in both.truth.names:
        assert change(both, measured(of, "chirp", alone, seconds=0.4)) > 0.1


def test_an_effect_that_is_not_known_is_refused() -> None:
    class Other(Effect):
        name = "other"

        def build(self, chain: object) -> None:
            """Something."""

    with pytest.raises(ValueError, match="does not know the effect other"):
        arm(Other(1.0))


@each_plant
def test_a_remounted_base_hangs_otherwise_in_every_recording(of: ModuleType) -> None:
    """By either side."""
    machines = [arm(EFFECTS["remounted_base"](0.05), of=of, seed=seed) for seed in range(12)]
    turned = np.array(
        [np.arctan2(one.plumb[0], -one.plumb[2]) if of is mujoco_plant else one.mechanism.base_tilt for one in machines]
    )
    assert np.unique(np.round(turned, 6)).size == 12
    assert np.all((np.abs(turned) > 0.025) & (np.abs(turned) < 0.075))
    assert set(np.sign(turned)) == {-1.0, 1.0}


@each_plant
def test_what_load_cells_show_is_more_than_what_pulls(of: ModuleType) -> None:
    machine = arm(EFFECTS["tension_scale"](0.2), of=of)
    machine.step(np.array([12.0, 11.0]))
    np.testing.assert_allclose(pulling(machine), [10.0, 10.0])


def test_a_ball_and_what_is_beyond_it_are_the_link() -> None:
    """Mass, first moment about the joint, and moment of inertia about it."""
    mass, centre, inertia = without_ball(0.22, 0.019, 8e-5)
    assert mass + BALL_MASS == pytest.approx(0.22)
    assert mass * centre == pytest.approx(0.22 * 0.019)
    assert inertia + mass * centre**2 + BALL_INERTIA == pytest.approx(8e-5 + 0.22 * 0.019**2)


@pytest.mark.parametrize(("of", "gives"), [(mujoco_plant, 1e-3), (moreau_plant, 1e-12)], ids=["mujoco", "moreau"])
def test_play_ends_at_its_stops(of: ModuleType, gives: float) -> None:
    """Free in between, and pressed to one or the other again and again; MuJoCo's stops give way by 1 mrad at most."""
    machine = arm(EFFECTS["backlash"](0.015, 2), of=of)
    machine.pull_to(1.5)
    angle = np.empty(round(0.5 / machine.dt))
    for k in range(angle.size):
        machine.step(NOTHING)
        in_play = (
            machine.data.qpos[machine.dof("play_2")] if of is mujoco_plant else machine.state.q[machine.chain.link[1]]
        )
        angle[k] = in_play
    assert np.ptp(angle) > 0.029  # from stop to stop
    assert np.abs(angle).max() < 0.015 + gives


@pytest.mark.parametrize(("of", "within"), [(mujoco_plant, 0.0), (moreau_plant, 0.5)], ids=["mujoco", "moreau"])
def test_a_lag_begins_at_the_instant_of_the_command(of: ModuleType, within: float) -> None:
    """What pulls in a step is that of its beginning, or of its middle."""
    machine = arm(EFFECTS["actuator_lag"](0.02), of=of)
    expected = 12 * (1 - np.exp(-machine.dt * (np.arange(200) + within) / 0.02))
    np.testing.assert_allclose(pulled(machine, [12.0, 0.0], 200), expected, atol=1e-3)


@each_plant
def test_a_sag_is_reeled_in_from_the_instant_of_the_command(of: ModuleType) -> None:
    """The arm hangs still until the cable is nearly taut."""
    machine = arm(EFFECTS["slack_cable"](0.004), of=of)
    taut_after = (0.004 - 0.001) / 0.3
    tension = pulled(machine, [12.0, 0.0], round(1.2 * taut_after / machine.dt))
    assert np.flatnonzero(tension)[0] == pytest.approx(taut_after / machine.dt, abs=1)


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


def test_an_elastic_cable_pulls_as_commanded_in_the_end() -> None:
    machine = arm(EFFECTS["elastic_cable"](2e-3))
    machine.settle(np.array([15.0, 0.0]), 0.01)
    assert machine.state.pulling[0] < 10.0
    machine.settle(np.array([15.0, 0.0]), 2.0)
    assert machine.state.pulling[0] == pytest.approx(15.0, rel=1e-3)
