"""Laws of every effect, whoever wrote it: its entry point finds it, absent at its defaults, derivatives, a file."""

import re
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import prototype_model, random_parameters
from effects_laws import (
    EFFECTS,
    EXACT,
    PULLS,
    RELEASED,
    STATEFUL,
    SUDDEN,
    N,
    drawn,
    effect_of,
    extended,
    is_size,
    prototype_with,
    random_with,
    resting_state,
    simulator,
)

import continuum.effects
from continuum.dynamics.balance import balance
from continuum.dynamics.effect import Effect
from continuum.dynamics.measuring import lateness
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import Reading, SimulationStatus
from continuum.dynamics.values import parameter_slots, parameter_vector, with_vector

pytestmark = pytest.mark.slow

each_effect = pytest.mark.parametrize("name", EFFECTS)
U = np.array([3.0, 1.5])
TIMES = np.linspace(0.0, 0.3, 13)
STEPS = {"slack_cable.blur": 1e-2}
"""Of parameters that move a run so little that smaller steps drown in rounding, in typical sizes."""
UNIT = re.compile(r"(1|(N|m|s|kg|rad)\d?( (N|m|s|kg|rad)\d?)*)(/((m|s|kg|rad)\d?|\(N m\)))?")


def moving_state(seed: int, n_states: int) -> tuple[np.ndarray, np.ndarray]:
    """State and rates of an arm that moves, effects' states positive."""
    random = np.random.default_rng(seed)
    x = np.concatenate([random.uniform(-0.5, 0.5, N), random.normal(0, 2, N), random.uniform(0.05, 0.6, n_states)])
    return x, np.concatenate([random.normal(0, 20, N), random.normal(0, 2, n_states)])


def test_every_file_of_the_package_is_offered() -> None:
    files = Path(continuum.effects.__file__).parent.glob("[!_]*.py")
    assert {file.stem for file in files} <= set(EFFECTS)


@each_effect
def test_names_agree_and_words_are_there(name: str) -> None:
    effect = effect_of(name)
    assert effect.name == name == type(effect).__module__.rpartition(".")[2]
    for words in (effect.in_words, effect.symptom, effect.experiment):
        assert words[0].isupper()
        assert words.endswith(".")
    assert effect.source
    assert (sys.modules[type(effect).__module__].__doc__ or "").strip()
    assert effect.state_sd >= 0


@each_effect
def test_parameters_are_bounded_and_have_a_size(name: str) -> None:
    assert effect_of(name).parameters
    assert any(is_size(parameter) for parameter in effect_of(name).parameters.values())
    for key, parameter in effect_of(name).parameters.items():
        assert UNIT.fullmatch(parameter.unit), parameter.unit
        assert parameter.default is not None, key
        assert parameter.typical is not None, key
        assert parameter.lower <= parameter.default < parameter.upper
        assert 0 < 3 * parameter.typical <= parameter.upper - parameter.default


@each_effect
def test_shapes_do_nothing_without_a_size(name: str) -> None:
    """At its defaults an effect is absent, and what is no size does not bring it back."""
    random = np.random.default_rng(3)
    plain = Model(random_parameters(random, N))
    shapes = {
        f"{name}.{key}": value
        for key, value in drawn(name, random).items()
        if not is_size(effect_of(name).parameters[key])
    }
    model = extended(plain, name)
    x, v = moving_state(1, 0)
    for changed in (model, model.with_values(shapes)):
        if model.n_states:
            rest = resting_state(changed, x[:N], U)[2 * N :]
            r = balance(changed, np.concatenate([x[:N], 0 * x[N:], rest]), np.append(v, np.zeros(rest.size)), U)
            np.testing.assert_allclose(r[:N], balance(plain, np.append(x[:N], 0 * x[N:]), v, U), rtol=1e-12)
        else:
            np.testing.assert_array_equal(balance(changed, x, v, U), balance(plain, x, v, U))


@pytest.mark.parametrize("name", STATEFUL)
def test_states_at_the_defaults_leave_the_motion_as_it_is(name: str) -> None:
    """To 0.15 degrees anywhere in a run: what `presliding` cannot do without; the others to a hundredth of that."""
    plain = Simulator(prototype_model(N), simulator(name).tolerances).run(RELEASED, TIMES, PULLS)
    model = prototype_with(name, 0.0)
    run = simulator(name).run(resting_state(model, RELEASED, PULLS.at(0.0)), TIMES, PULLS)
    assert run.status is SimulationStatus.COMPLETE
    limit = 0.15 if name == "presliding" else 0.02
    assert np.degrees(np.abs(run.theta - plain.theta)).max() < limit


@pytest.mark.parametrize("name", STATEFUL)
@pytest.mark.parametrize("times_typical", [0.0, 1.0])
def test_states_rest_where_they_begin_and_their_equations_have_a_solution(name: str, times_typical: float) -> None:
    model = prototype_with(name, times_typical)
    x0, size = resting_state(model, RELEASED, U), N + model.n_states
    assert x0.shape == (N + size,)
    np.testing.assert_allclose(balance(model, x0, np.zeros(size), U)[N:], 0, atol=1e-12)
    _, by_v, _ = simulator(name).equations.balance(x0, np.zeros(size), U, parameter_vector(model))
    scale = np.abs(by_v).max(axis=1, keepdims=True)
    assert np.linalg.cond(by_v / scale) < 1e5


@each_effect
def test_compiled_equations_are_those_of_numbers(name: str) -> None:
    """As written and as compiled alike, and exact derivatives along random ways by differences of the former."""
    for seed in range(2):
        model = random_with(name, seed)
        x, v = moving_state(seed, model.n_states)
        p = parameter_vector(model)
        compiled = simulator(name).equations
        r, by_v, by_x = compiled.balance(x, v, U, p)
        np.testing.assert_allclose(r, balance(model, x, v, U), rtol=1e-11, atol=1e-11)
        ways = np.random.default_rng(seed).normal(size=(x.size + v.size + p.size, 6))
        ways[x.size + v.size :] *= np.maximum(np.abs(p), 1e-3)[:, None]

        def along(way: np.ndarray, model=model, x=x, v=v, p=p, ways=ways) -> np.ndarray:
            dx, dv, dp = np.split(ways @ way, [x.size, x.size + v.size])
            return balance(with_vector(model, p + dp), x + dx, v + dv, U)

        sensitivities = np.concatenate([by_x, by_v, compiled.parameter_jacobian(x, v, U, p)], axis=1) @ ways
        expected = differences(along, np.zeros(6), 1e-4)
        size = np.abs(expected).max(axis=1, keepdims=True)
        np.testing.assert_allclose(sensitivities / size, expected / size, rtol=0, atol=1e-6)


@each_effect
@pytest.mark.parametrize("times_typical", [0.0, 3.0])
def test_a_release_of_the_prototype_and_its_derivatives(name: str, times_typical: float) -> None:
    """By the effect's own parameters, against differences of runs; at the lower bound to one side."""
    model = prototype_with(name, times_typical)
    fast, params = simulator(name, SUDDEN.get(name, EXACT)).around(model), effect_of(name).parameters
    slots, p = parameter_slots(model), parameter_vector(model)
    x0 = resting_state(model, RELEASED, PULLS.at(0.0))
    free = np.zeros((p.size, len(params)))
    for column, (key, parameter) in enumerate(params.items()):
        free[slots[f"{name}.{key}"], column] = parameter.typical
    run = fast.run(x0, TIMES, PULLS, free=free)
    assert run.status is SimulationStatus.COMPLETE
    assert np.all(np.isfinite(run.sensitivities))
    for column, (key, parameter) in enumerate(params.items()):
        step = STEPS.get(f"{name}.{key}", 1e-4 if times_typical or not is_size(parameter) else 1e-5)
        lowest = min(p[slots[f"{name}.{key}"]]) - 2 * step * parameter.typical < parameter.lower
        shifts, weights = ((0, 1, 2), (-1.5, 2.0, -0.5)) if lowest else ((-1, 0, 1), (-0.5, 0.0, 0.5))
        runs = [fast.run(x0, TIMES, PULLS, p + step * k * free[:, column]) for k in shifts]
        expected = sum(w * r.states for w, r in zip(weights, runs, strict=True)) / step
        found = run.sensitivities[:, : 2 * N, column]
        size = np.abs(expected[:, : 2 * N]).max() + 1e-3
        np.testing.assert_allclose(found / size, expected[:, : 2 * N] / size, rtol=0, atol=0.02, err_msg=key)


def mirrored(model: Model, name: str) -> Model:
    """The arm's mirror image: what has a sign by its bounds turns it, and cables change sides."""
    params = effect_of(name).parameters
    values = model.values()
    turned = {
        f"{name}.{key}": -values[f"{name}.{key}"]
        for key, parameter in params.items()
        if parameter.lower == -parameter.upper
    }
    swapped = {f"{name}.{key}": values[f"{name}.{_other_cable(key)}"] for key in params if _other_cable(key) in params}
    return model.with_values(turned | swapped)


def _other_cable(key: str) -> str:
    return key.translate(str.maketrans("12", "21")) if key[-1] in "12" else ""


@each_effect
def test_a_mirrored_arm_moves_mirrored(name: str) -> None:
    random = np.random.default_rng(7)
    model = prototype_with(name, 1.0)
    model = model.with_values({f"{name}.{key}": value for key, value in drawn(name, random).items()})
    runs = []
    for arm, side, pulls in (
        (model, 1.0, PULLS),
        (mirrored(model, name), -1.0, Tensions(PULLS.times, PULLS.values[:, ::-1])),
    ):
        start = resting_state(arm, side * RELEASED, pulls.at(0.0))
        runs.append(side * simulator(name).around(arm).run(start, TIMES, pulls).theta)
    np.testing.assert_allclose(runs[0], runs[1], rtol=0, atol=1e-6)


@each_effect
def test_what_it_does_is_seen(name: str) -> None:
    """At its typical size it changes what the sensors read of a pulled release by a tenth of a degree at least."""
    seen = []
    for size in (0.0, 1.0):
        model = prototype_with(name, size)
        pulls = PULLS.later(lateness(model))
        run = simulator(name).around(model).run(resting_state(model, RELEASED, pulls.at(0.0)), TIMES, pulls)
        reading = Reading(run.times, run.theta, run.theta_rate, 0.0)
        seen.append(model.effects[0].effect.measure(reading, model.effects[0].values).theta)
    assert np.degrees(np.abs(seen[1] - seen[0])).max() > 0.1


def a_reading(seed: int) -> Reading:
    random = np.random.default_rng(seed)
    return Reading(np.linspace(0.4, 0.7, 20), random.normal(size=(20, N)), random.normal(size=(20, N)), 0.1)


@each_effect
def test_measuring_is_affine_in_the_motion_and_nothing_at_the_defaults(name: str) -> None:
    effect, one, two = effect_of(name), a_reading(1), a_reading(2)
    params = random_with(name, 5).effects[0].values
    mixed = replace(
        one, theta=0.3 * one.theta + 0.7 * two.theta, theta_rate=0.3 * one.theta_rate + 0.7 * two.theta_rate
    )
    seen_one, seen_two, seen = (effect.measure(reading, params) for reading in (one, two, mixed))
    np.testing.assert_allclose(seen.theta, 0.3 * seen_one.theta + 0.7 * seen_two.theta, atol=1e-12)
    np.testing.assert_allclose(seen.theta_rate, 0.3 * seen_one.theta_rate + 0.7 * seen_two.theta_rate, atol=1e-9)
    absent = effect.measure(one, prototype_with(name, 0.0).effects[0].values)
    np.testing.assert_allclose(absent.theta, one.theta, atol=1e-12)
    np.testing.assert_allclose(absent.theta_rate, one.theta_rate, atol=1e-10)
    np.testing.assert_array_equal(absent.times, one.times)


@each_effect
def test_hooks_change_nothing_that_they_are_given(name: str) -> None:
    model = random_with(name, 6)
    x, v = moving_state(6, model.n_states)
    reading = a_reading(3)
    parameters = model.parameters.named().values()
    given = [x, v, *parameters, *model.effects[0].values.values(), reading.theta, reading.theta_rate, reading.times]
    for array in given:
        array.setflags(write=False)
    np.testing.assert_array_equal(balance(model, x, v, U), balance(model, x, v, U))
    effect, params = model.effects[0].effect, model.effects[0].values
    np.testing.assert_array_equal(effect.measure(reading, params).theta, effect.measure(reading, params).theta)
    effect.initial_state(x[:N], U, params, model.parameters)


@each_effect
def test_model_files_hold_it(name: str, tmp_path: Path) -> None:
    model = random_with(name, 8)
    save_model(model, tmp_path / "model.yaml")
    found = load_model(tmp_path / "model.yaml")
    assert type(found.effects[0].effect) is type(model.effects[0].effect)
    for key, value in model.values().items():
        np.testing.assert_array_equal(found.values()[key], value)
    x, v = moving_state(8, model.n_states)
    np.testing.assert_array_equal(balance(found, x, v, U), balance(model, x, v, U))


class Halved(Effect):
    """Half of the command: an effect ahead of another one."""

    name = "halved"

    def pull(self, u: np.ndarray, params: object, state: np.ndarray) -> np.ndarray:
        return u / 2


def test_an_effect_with_states_receives_the_tension_of_the_effect_before_it() -> None:
    lag = extended(prototype_model(N), "actuator_lag", {"lag": 0.1})
    model = replace(lag, effects=(replace(lag.effects[0], effect=Halved(), values={}), *lag.effects))
    x, v = moving_state(9, 2)
    v[N:] = 0.0
    np.testing.assert_allclose(balance(model, x, v, U)[N:], x[2 * N :] - U / 2, rtol=1e-12)
