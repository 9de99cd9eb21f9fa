"""Hidden effects: each shows at medium size, and fades with its size."""

from functools import cache

import numpy as np
import pytest

from blind.plant import EFFECTS, Case, Machine, make_case, prototype
from blind.plant.chain import BALL_INERTIA, BALL_MASS, without_ball
from blind.plant.parameters import GRAVITY
from blind.plant.sensors import ORDINARY

pytestmark = pytest.mark.slow

SEED = 3
# as multiples of medium; a winch and a ring of fixed size go only with the effect as a whole, and a joint that hardly
# gives before it slips is too stiff for the step
FADED = dict.fromkeys(EFFECTS, 0.0005) | {"elastic_cable": 0.0, "backlash": 0.0, "presliding": 2e-3}


def measured(regime: str, *effects: str, size: str | float = "medium", seconds: float = 1.0) -> Case:
    return make_case(effects, size, [regime], SEED, seconds=seconds)


@cache
def clean(regime: str, seconds: float = 1.0) -> Case:
    return measured(regime, seconds=seconds)


def change(case: Case, other: Case) -> float:
    """Difference in what is read without noise, root mean square over rows and joints, over the noise's deviation."""
    difference = case.without_noise["run_1.csv"] - other.without_noise["run_1.csv"]
    return float(np.sqrt(np.mean(difference**2)) / ORDINARY.joint_angle())


@pytest.mark.parametrize("name", EFFECTS)
def test_an_effect_shows_at_medium_size(name: str) -> None:
    regime = "release" if "release" in EFFECTS[name].seen_in else "hold_and_release"
    assert change(measured(regime, name), clean(regime)) > 1.0


@pytest.mark.parametrize("name", EFFECTS)
def test_an_effect_fades_with_its_size(name: str) -> None:
    assert change(measured("chirp", name, size=FADED[name], seconds=0.4), clean("chirp", 0.4)) < 0.2


def test_effects_act_together() -> None:
    both = measured("chirp", "tip_payload", "backlash", seconds=0.4)
    assert both.truth.names == ("tip_payload", "backlash")
    for alone in both.truth.names:
        assert change(both, measured("chirp", alone, seconds=0.4)) > 0.1


def test_a_remounted_base_hangs_otherwise_in_every_recording() -> None:
    """Gravity turns against the plate, by either side, and as far as before from its old length."""
    p, kind = prototype(), EFFECTS["remounted_base"]
    machines = [Machine(p, [kind(0.05)], np.random.default_rng(seed)) for seed in range(12)]
    turned = np.array([np.arctan2(one.plumb[0], -one.plumb[2]) for one in machines])
    np.testing.assert_allclose([np.linalg.norm(one.model.opt.gravity) for one in machines], GRAVITY)
    assert np.unique(np.round(turned, 6)).size == 12
    assert (turned > 0).any() and (turned < 0).any()  # noqa: PT018
    assert np.all((np.abs(turned) > 0.025) & (np.abs(turned) < 0.075))


def test_what_load_cells_show_is_more_than_what_pulls() -> None:
    machine = Machine(prototype(), [EFFECTS["tension_scale"](0.2)], np.random.default_rng(0))
    machine.step(np.array([12.0, 11.0]))
    np.testing.assert_allclose(machine.pulling, [10.0, 10.0])


def test_a_ball_and_what_is_beyond_it_are_the_link() -> None:
    """Mass, first moment about the joint, and moment of inertia about it."""
    mass, centre, inertia = without_ball(0.22, 0.019, 8e-5)
    assert mass + BALL_MASS == pytest.approx(0.22)
    assert mass * centre == pytest.approx(0.22 * 0.019)
    assert inertia + mass * centre**2 + BALL_INERTIA == pytest.approx(8e-5 + 0.22 * 0.019**2)


def test_play_ends_at_its_stops_and_what_is_pressed_to_them_stays() -> None:
    """Hard stops give way by 1 mrad at most, and no ball flies off one that it is pressed to."""
    machine = Machine(prototype(), [EFFECTS["backlash"](0.015, 2)], np.random.default_rng(0))
    machine.pull_to(1.5)
    play, steps = machine.dof("play_2"), 120 * machine.steps // 2
    told = np.empty((steps, 2))
    for row in told:
        machine.step(np.zeros(2))
        row[:] = machine.data.qpos[play], machine.data.qvel[play]
    angle, rate = told.T
    assert np.ptp(angle) > 0.029  # from stop to stop
    assert np.abs(angle).max() < 0.015 + 1e-3
    assert np.abs(np.diff(rate)).max() < 1.0


def pulled(machine: Machine, command: list[float], steps: int) -> np.ndarray:
    """Tension of the first cable [N] at so many instants, told from the first on."""
    found = []
    for _ in range(steps):
        machine.step(np.array(command))
        found.append(machine.pulling[0])
    return np.array(found)


def test_a_lag_begins_at_the_instant_of_the_command() -> None:
    machine = Machine(prototype(), [EFFECTS["actuator_lag"](0.02)], np.random.default_rng(0))
    since = machine.dt * np.arange(200)
    np.testing.assert_allclose(pulled(machine, [12.0, 0.0], 200), 12 * (1 - np.exp(-since / 0.02)), rtol=1e-9)


def test_a_sag_is_reeled_in_from_the_instant_of_the_command() -> None:
    """Less than a step late: the arm hangs still until the cable is nearly taut."""
    machine = Machine(prototype(), [EFFECTS["slack_cable"](0.004)], np.random.default_rng(0))
    reeled_in = (0.004 - 0.001) / 0.3
    tension = pulled(machine, [12.0, 0.0], round(1.2 * reeled_in / machine.dt))
    assert np.flatnonzero(tension)[0] == np.ceil(reeled_in / machine.dt)
