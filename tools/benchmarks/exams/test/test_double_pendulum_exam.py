"""What the exam does to recordings and models, how it predicts and compares, and that its page shows every result."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from continuum.discovery.decision import Kind
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.simulator import Simulator
from continuum.recordings.recording import Recording
from tools.benchmarks.exams import pendulum_runs
from tools.benchmarks.exams.pendulum_prediction import Error, Prediction, fitted_offsets, predicted, readings
from tools.benchmarks.exams.pendulum_runs import (
    delayed,
    folded,
    nominal,
    turned,
    with_half_the_last_mass,
    with_makers_friction,
)
from tools.benchmarks.exams.pendulum_torques import TorqueChoice, TorqueFit, difference
from tools.benchmarks.exams.two_joints import EXTENDED, MAKERS, Answers
from tools.benchmarks.exams.two_joints_page import section
from tools.benchmarks.exams.two_joints_values import friction

T = np.arange(0, 2.5, 0.004)
DRIVE = JointTorques(T, np.column_stack([0.6 * np.sin(5 * T), 0.4 * np.sin(9 * T)]))


def run_of(model: Model, offsets: tuple[float, float] = (0.0, 0.0)) -> Recording:
    """What sensors with these offsets [rad] read of a model's motion."""
    motion = Simulator(model).run(np.zeros(2), T, DRIVE)
    return Recording("run_00", T, motion.theta + offsets, motion.theta_rate, torques=DRIVE)


def extended() -> Model:
    return replace(
        with_makers_friction(),
        effects=(ActiveEffect(effect_named("rotor_inertia"), {"ratio": np.array([0.1, 0.2])}),),
    )


def test_the_runs_have_the_torques_that_are_named(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(repository)
    (run,) = pendulum_runs.recordings(["run_12"], ("commanded", "measured"))
    table = np.genfromtxt(repository / "data/double_pendulum/run_12.csv", delimiter=",", names=True)
    assert run.name == "run_12"
    values, table = run.inputs_for(nominal()).values, table[np.isin(table["t_s"], run.times)]
    np.testing.assert_array_equal(values[:, 0], table["tau_commanded_1_Nm"])
    np.testing.assert_array_equal(values[:, 1], table["tau_measured_2_Nm"])
    assert not np.any(values[:, 0]), "the page says that joint 1 of this run is commanded nothing"


def test_a_turned_angle_is_off_by_that_and_others_stay() -> None:
    run = run_of(nominal())
    moved = turned(run, 1, 0.05)
    np.testing.assert_allclose(moved.theta - run.theta, np.broadcast_to([0.0, 0.05], run.theta.shape), atol=1e-15)


def test_a_delayed_angle_shows_what_was_before() -> None:
    run = run_of(nominal())
    late = delayed(run, 1, 3 * 0.004)
    np.testing.assert_allclose(late.theta[3:, 1], run.theta[:-3, 1], atol=1e-9)
    np.testing.assert_array_equal(late.theta[:, 0], run.theta[:, 0])
    np.testing.assert_array_equal(late.theta_rate, run.theta_rate)


def test_folding_leaves_the_motion_and_no_effect() -> None:
    model = extended()
    assert folded(model).effects == ()
    np.testing.assert_allclose(run_of(folded(model)).theta, run_of(model).theta, atol=1e-10)


def test_an_effect_that_is_no_parameter_is_not_folded() -> None:
    drag = ActiveEffect(effect_named("quadratic_drag"), {"drag": np.array([0.01, 0.01])})
    model = replace(extended(), effects=(*extended().effects, drag))
    assert folded(model).effects == (drag,)


def test_half_of_the_last_mass_comes_back_by_the_effect_at_one() -> None:
    model, missing = extended(), {"mass": np.array([0.0, 1.0]), "inertia": np.zeros(2)}
    restored = effect_named("inertia").change_parameters(with_half_the_last_mass(model).parameters, missing)
    for name, value in model.changed_parameters.named().items():
        np.testing.assert_allclose(restored.named()[name], value, rtol=1e-12)


@pytest.mark.parametrize("length", [0.5, np.inf])
def test_a_model_predicts_its_own_motion(length: float) -> None:
    model, offsets = with_makers_friction(), np.array([0.03, -0.05])
    run = run_of(model, (0.03, -0.05))
    found = readings(Simulator(model), run, length, offsets)
    np.testing.assert_allclose(found, run.theta, atol=np.radians(0.02))
    assert np.max(np.abs(readings(Simulator(nominal()), run, length, offsets) - run.theta)) > np.radians(2)


def test_the_offsets_of_a_run_are_found() -> None:
    model = with_makers_friction()
    np.testing.assert_allclose(fitted_offsets(Simulator(model), run_of(model, (0.03, -0.05))), [0.03, -0.05], atol=2e-3)


def test_errors_of_a_prediction_are_root_mean_squares_of_each_joint() -> None:
    model = with_makers_friction()
    run = run_of(model, (0.03, 0.0))
    one = predicted(model, run)
    assert one.whole_with_offsets.rms[0] < 0.1 * one.whole.rms[0]
    found = readings(Simulator(model), run, np.inf, np.zeros(2))
    np.testing.assert_allclose(one.whole.rms, np.sqrt(np.mean((found - run.theta) ** 2, axis=0)))


def choice(torques: tuple[str, str], *errors: np.ndarray, independent: float = 50.0) -> TorqueChoice:
    """Fits of one set and one way to take inputs, from several starts."""
    return TorqueChoice(torques, tuple(TorqueFit("set", True, e, independent) for e in errors), 1.0)


SEGMENTS = np.random.default_rng(0).uniform(0.5, 2.0, 20)


def test_a_choice_that_errs_twice_as_much_everywhere_is_less_likely() -> None:
    near, far = choice(("measured", "measured"), SEGMENTS), choice(("commanded", "measured"), 2 * SEGMENTS)
    d = difference(far, near)
    assert (d.log_likelihood, d.low, d.high) == pytest.approx((50 * np.log(2),) * 3)
    assert not d.is_chance


def test_choices_whose_segments_differ_either_way_are_alike() -> None:
    noise = np.exp(np.random.default_rng(1).normal(scale=0.5, size=20))
    d = difference(choice(("a", "b"), SEGMENTS * noise), choice(("a", "a"), SEGMENTS / noise))
    assert d.low < 0 < d.high
    assert d.is_chance


def test_a_difference_as_large_as_that_between_starts_is_chance() -> None:
    near = choice(("measured", "measured"), SEGMENTS, 1.5 * SEGMENTS)
    d = difference(choice(("commanded", "measured"), 1.2 * SEGMENTS), near)
    assert d.low > 0
    assert d.by_start == pytest.approx(50 * np.log(1.5))
    assert d.is_chance


def estimate(text: str, value: float, joint: int | None = None, unit: str = "N m", recording: str = "") -> object:
    return type("Made", (SimpleNamespace,), {"__str__": lambda self: text})(
        name=text,
        joint=joint,
        recording=recording,
        value=value,
        low=value - 0.01,
        high=value + 0.01,
        meaning="",
        unit=unit,
    )


def diagnosis(kind: str, *sets: tuple[SimpleNamespace, ...]) -> SimpleNamespace:
    error = SimpleNamespace(of_segments=0.01)
    verdict = SimpleNamespace(kind=Kind(kind), relative_fits=[1 / len(sets)] * len(sets), complete=False)
    return SimpleNamespace(
        verdict=verdict, sets=sets, before=error, after=error, seconds=1.0, sigma=(np.ones(2), np.array([2.0, 0.5])),
        extended_model=extended(), refitted_model=nominal(), recordings=(run_of(nominal()),),
    )  # fmt: skip


def cause(effect: str, *estimates: object) -> SimpleNamespace:
    return SimpleNamespace(effect=effect, label=f"{effect}@x", joints=(0,), estimates=estimates)


def page(coulomb: float = 0.155, lag: float = 0.05) -> str:
    rub = cause("joint_friction", estimate("coulomb_friction", coulomb, 0), estimate("coulomb_friction", 0.12, 1))
    zero = [cause("angle_offset", estimate("angle_offset.offset", o, 1, "rad", "run_00")) for o in (0.01, 0.05)]
    late = cause("sensor_delay", estimate("sensor_delay.lag", lag, 1, "s"))
    mass = cause("inertia", estimate("inertia.mass", 1.0, 1, "1"))
    plain = Error(np.array([0.1, 0.2]), 0.5)
    found = Answers(
        diagnosis("ambiguous", (rub, zero[0]), (rub,)), diagnosis("cause", (mass,)), diagnosis("cause", (zero[1],)),
        diagnosis("unknown", (late,)),
        (choice(("measured", "measured"), SEGMENTS), choice(("commanded", "measured"), 2 * SEGMENTS)),
        dict.fromkeys((MAKERS, EXTENDED), Prediction(plain, plain, np.array([0.1, 0.2]), plain, plain)),
        ("row 3 left out",),
    )  # fmt: skip
    return " ".join(section(found).text.split())


def test_the_page_shows_every_result_right_or_wrong() -> None:
    text = page()
    assert text.count("| `cause` |") == 2
    assert "| `ambiguous` | joint_friction@x + angle_offset@x (0.50); joint_friction@x (0.50) |" in text
    assert "| `unknown` | none; sensor_delay@x helps most |" in text
    assert "No effect of any set acts on cables" in text
    assert "moves by 2.29 degrees" in text  # 0.04 rad
    assert "commanded / measured is farther than chance" in text
    assert "At joint 1 nothing is gained" in text
    assert "row 3 left out" in text


def test_an_effect_on_cables_is_reported() -> None:
    text = " ".join(friction(diagnosis("cause", (cause("joint_friction"), cause("capstan")))).split())
    assert "Acting on cables: capstan@x." in text


def test_the_page_separates_intervals_that_hold_a_known_value_from_those_that_miss_it() -> None:
    assert page(coulomb=0.155).count("N m, holds it") == 4  # of two joints, in two sets
    assert (page(coulomb=0.2).count("N m, holds it"), page(coulomb=0.2).count("N m, misses it")) == (2, 2)
    assert " s, holds it" in page(lag=0.012)
    assert " s, misses it" in page(lag=0.05)


@pytest.fixture
def repository() -> Path:
    return Path(__file__).parents[4]
