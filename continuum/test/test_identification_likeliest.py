"""Unknowns that mean the same arm: the same motion, by what the prior likes best."""

from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest
from dynamics_laws import active, prototype_model
from effects_laws import EFFECTS, N, effect_of, random_with
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.balance import balance
from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.felt_values import felt_values
from continuum.dynamics.model import Model
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.reading import Reading
from continuum.dynamics.values import with_vector
from continuum.identification.baseline import baseline_unknowns
from continuum.identification.free import Free, FreeSpace
from continuum.identification.likeliest import likeliest

STIFFNESS = [Free("stiffness"), *(Free("stiffness", j, tolerance=0.02) for j in range(3))]
U = np.array([3.0, 1.5])


def model_with(*names: str) -> Model:
    return Model(prototype_model(3).parameters, tuple(active(effect_of(name), 3) for name in names))


def prior(space: FreeSpace, coordinates: np.ndarray) -> float:
    return float(np.sum((coordinates / space.spread) ** 2)) / 2


@given(st.lists(st.floats(-2.4, 2.4), min_size=4, max_size=4))
def test_the_same_values_by_less(drawn: list[float]) -> None:
    model = model_with("angle_offset").with_values({"stiffness": [1.0, 1.5, 2.0]})
    own = [Free("angle_offset.offset", 2, run) for run in (0, 1)]
    space = FreeSpace(model, [*STIFFNESS, *own])
    one = np.array([0.1 * drawn[0], *drawn[1:], 0.7, -0.3])
    other = likeliest(space, model, one)
    for recording in (0, 1):
        directions = space.directions_of(recording)
        np.testing.assert_allclose(directions @ other, directions @ one, rtol=1e-12, atol=1e-14)
    assert np.array_equal(other, space.clipped(other))
    assert prior(space, other) <= prior(space, one) + 1e-9


def test_what_all_parts_share_is_common() -> None:
    model = model_with().with_values({"stiffness": 1.5})
    space = FreeSpace(model, STIFFNESS)
    found = likeliest(space, model, np.array([0.0, 2.0, 2.0, 2.0]))  # each joint's spring 4 % stiffer
    np.testing.assert_allclose(space.amounts(found), [0.06, 0.0, 0.0, 0.0], atol=1e-4)


@pytest.mark.parametrize(
    ("effect", "parameter", "baseline"),
    [
        ("joint_stiffness", "excess", "stiffness"),
        ("joint_friction", "coulomb", "coulomb_friction"),
        ("inertia", "mass", "mass"),
    ],
)
def test_what_is_no_part_of_a_batch_is_the_effect_s(effect: str, parameter: str, baseline: str) -> None:
    """A joint two and a half standard deviations off beside an effect that is too small by as much."""
    model = model_with(effect)
    own = Free(f"{effect}.{parameter}", 1)
    space = FreeSpace(model, [Free(baseline), *(Free(baseline, j, tolerance=0.02) for j in range(3)), own])
    truth = np.array([0.0, 0.0, 0.0, 0.0, 0.3 / space.scale[-1]])
    taken = (1.3 / 1.05 - 1) / space.scale[-1]
    found = likeliest(space, model, np.array([0.0, 0.0, 2.5, 0.0, taken]))
    np.testing.assert_allclose(found, truth, atol=0.1)


def test_what_would_leave_its_bounds_ends_there() -> None:
    """Three springs stiffer by 1.5 %, of which what all share can take hardly 1 %."""
    model = model_with().with_values({"stiffness": 9900.0})
    space = FreeSpace(model, [STIFFNESS[0], *(Free("stiffness", j, tolerance=0.01) for j in range(3))])
    one = np.array([0.005, 1.0, 1.0, 1.0])
    found = likeliest(space, model, one)
    assert found[0] == space.upper[0]
    np.testing.assert_allclose(found[1:], (0.015 - found[0]) / 0.01, rtol=1e-6)
    np.testing.assert_allclose(space.directions_of(-1) @ found, space.directions_of(-1) @ one, rtol=1e-9)


def test_a_size_of_one_sign_ends_at_nothing() -> None:
    model = model_with("capstan").with_values({"capstan_friction": 0.2})
    space = FreeSpace(model, [Free("capstan_friction", tolerance=0.03), Free("capstan.friction")])
    found = likeliest(space, model, np.array([-2.5, 0.1]))
    np.testing.assert_allclose(found, [-2.5 + 0.01 / 0.006, 0.0], atol=1e-6)


def test_what_is_beyond_its_bounds_and_cannot_move_holds_up_nothing() -> None:
    model = model_with("angle_offset")
    space = FreeSpace(model, [*STIFFNESS, Free("angle_offset.offset", 2, 0)])
    found = likeliest(space, model, np.array([0.0, 2.0, 2.0, 2.0, 1e6]))
    assert found[4] == 1e6
    assert np.abs(found[1:4]).max() < 0.01


class Wear(Effect):
    """Springs that wear: not a number below nothing."""

    name = "wear"
    parameters: ClassVar = {"wear": Parameter("w", "1", 0.0, 1.0, True, "wear", 0.0, 0.1)}

    def change_parameters(self, p: Parameters, own: Own) -> Parameters:
        return replace(p, stiffness=p.stiffness * (1 - own["wear"] ** 1.5))


class Holed(Effect):
    """Springs that are no number where the effect is absent."""

    name = "holed"
    parameters: ClassVar = {"size": Parameter("s", "1", 0.0, 1.0, True, "size", 0.0, 0.1)}

    def change_parameters(self, p: Parameters, own: Own) -> Parameters:
        return replace(p, stiffness=p.stiffness * (1 + (own["size"] - 0.05) ** 0.5))


class Warmth(Effect):
    """Springs that soften by how warm it was in each recording."""

    name = "warmth"
    parameters: ClassVar = {
        "softening": Parameter("s", "1", -1.0, 1.0, True, "softening", 0.0, 0.1),
        "warm": Parameter("w", "1", -1.0, 1.0, False, "how warm it was", 0.0, 1.0, per_recording=True),
    }

    def change_parameters(self, p: Parameters, own: Own) -> Parameters:
        return replace(p, stiffness=p.stiffness * (1 - own["softening"] * own["warm"]))


@pytest.mark.parametrize("worn", [0.0, 0.5, 3.0])
def test_an_effect_that_is_no_number_beyond_its_bounds(worn: float) -> None:
    model = Model(prototype_model(3).parameters, (active(Wear(), 3),))
    space = FreeSpace(model, [*STIFFNESS, *(Free("wear.wear", j) for j in range(3))])
    one = np.array([0.2, 1.0, -1.0, 0.5, worn, 0.0, worn])
    found = likeliest(space, model, one)
    same, there = (with_vector(model, space.origin + space.directions @ at) for at in (one, found))
    np.testing.assert_allclose(felt_values(there), felt_values(same), rtol=1e-6)
    assert prior(space, found) < prior(space, one)
    assert np.array_equal(found, space.clipped(found))


@pytest.mark.filterwarnings("ignore:invalid value")
def test_where_an_effect_is_no_number_nothing_moves() -> None:
    model = Model(prototype_model(3).parameters, (active(Holed(), 3, size=0.06),))
    space = FreeSpace(model, [*STIFFNESS, Free("holed.size", 1)])
    one = np.array([0.2, 1.0, -1.0, 0.5, -0.6])
    np.testing.assert_array_equal(likeliest(space, model, one), one)


def test_what_only_recordings_show_is_kept() -> None:
    model = Model(prototype_model(3).parameters, (active(Warmth(), 3),))
    own = [Free("warmth.warm", recording=run) for run in (0, 1)]
    space = FreeSpace(model, [*STIFFNESS, *(Free("warmth.softening", j) for j in range(3)), *own])
    one = np.array([0.2, 1.0, -1.0, 0.5, 1.0, 2.0, 3.0, 0.5, 1.0])
    found = likeliest(space, model, one)
    for run in (0, 1):
        same, there = (with_vector(model, space.origin + space.directions_of(run) @ at) for at in (one, found))
        np.testing.assert_allclose(there.changed_parameters.stiffness, same.changed_parameters.stiffness, rtol=1e-7)


@pytest.mark.parametrize("name", EFFECTS)
def test_of_every_effect_the_likeliest_arm_moves_and_is_measured_alike(name: str) -> None:
    model = random_with(name, 7)
    parameters = model.effects[0].effect.parameters
    own = [
        Free(f"{name}.{key}", joint)
        for key, meaning in parameters.items()
        for joint in (range(N) if meaning.per_joint else [None])
    ]
    space = FreeSpace(model, [*baseline_unknowns(model), *own])
    random = np.random.default_rng(3)
    one = space.clipped(0.5 * space.spread * random.normal(size=len(space.unknowns)))
    other = likeliest(space, model, one)
    assert prior(space, other) < prior(space, one) - 0.01
    same, there = (with_vector(model, space.origin + space.directions_of(-1) @ at) for at in (one, other))
    np.testing.assert_allclose(felt_values(same), felt_values(there), rtol=1e-7, atol=1e-9)
    x = np.concatenate(
        [random.uniform(-0.5, 0.5, N), random.normal(0, 2, N), random.uniform(0.05, 0.6, model.n_states)]
    )
    v = np.concatenate([random.normal(0, 20, N), random.normal(0, 2, model.n_states)])
    left = [balance(m, x, v, U) for m in (same, there)]
    np.testing.assert_allclose(left[1], left[0], rtol=1e-6, atol=1e-6)
    reading = Reading(np.arange(4.0), random.normal(size=(4, N)), random.normal(size=(4, N)), 0.0)
    seen = [m.effects[0].effect.measure(reading, m.effects[0].values) for m in (same, there)]
    np.testing.assert_allclose(seen[1].theta, seen[0].theta, rtol=1e-7, atol=1e-9)
    late = [m.effects[0].effect.late(m.effects[0].values) for m in (same, there)]
    np.testing.assert_allclose(late[1], late[0], rtol=1e-7, atol=1e-9)
