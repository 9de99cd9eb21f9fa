"""An effect as an extension of a model, and at which joints it acts."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from discovery_laws import quadratic
from dynamics_laws import accelerations, prototype_model
from effects_laws import EFFECTS, effect_of, resting_state

from continuum.discovery.candidate import SMALL, USUAL, Addition, acts_at_joints, beginning, extended, unknowns_of
from continuum.discovery.joints import acting_joints
from continuum.dynamics.reading import Reading
from continuum.errors import InvalidValueError
from continuum.identification.baseline import baseline_unknowns
from continuum.identification.free import Free, FreeSpace

N = 5
MODEL = prototype_model(N)
BENT = np.radians([18.0, 15.0, -17.0, 12.0, 14.0])
PULL = np.array([5.0, 1.0])


@pytest.mark.parametrize("effect", EFFECTS)
def test_an_effect_is_absent_until_it_is_moved(effect: str) -> None:
    """Same accelerations, same readings; states of a lag answer so fast that they are as good as none."""
    model = extended(MODEL, (Addition(effect),))
    bare = accelerations(MODEL, np.concatenate([BENT, np.zeros(N)]), PULL)
    with_it = accelerations(model, resting_state(model, BENT, PULL), PULL)
    np.testing.assert_allclose(with_it[:N], bare, rtol=1e-6, atol=1e-6)
    seen = Reading(np.arange(3) / 120, np.outer([1.0, 0.9, 0.7], BENT), np.outer([0.0, 1.0, 2.0], BENT), 0.0)
    measured = model.effects[0].effect.measure(seen, model.effects[0].values)
    np.testing.assert_allclose(measured.theta, seen.theta, atol=1e-12)
    np.testing.assert_allclose(measured.theta_rate, seen.theta_rate, atol=1e-12)


def test_effects_are_added_to_those_that_a_model_has() -> None:
    model = extended(extended(MODEL, (Addition("tip_payload"),)), (Addition("base_tilt"), Addition("sensor_delay")))
    assert [a.effect.name for a in model.effects] == ["tip_payload", "base_tilt", "sensor_delay"]
    assert model.parameters is MODEL.parameters
    assert extended(MODEL, ()) == MODEL


def test_an_effect_that_is_not_installed() -> None:
    with pytest.raises(InvalidValueError, match="effect is 'gremlins'"):
        extended(MODEL, (Addition("gremlins"),))


@pytest.mark.parametrize("effect", EFFECTS)
@pytest.mark.parametrize("joints", [None, (1,), (0, 3)])
def test_unknowns_are_those_of_its_parameters(effect: str, joints: tuple[int, ...] | None) -> None:
    """Each one at every joint and in every recording where it has a value of its own; each moves the model."""
    unknowns = unknowns_of(Addition(effect, joints), N, 3)
    assert len(unknowns) == len(set(unknowns))
    at = N if joints is None else len(joints)
    count = sum(
        (at if p.per_joint else 1) * (3 if p.per_recording else 1) for p in effect_of(effect).parameters.values()
    )
    assert len(unknowns) == count
    assert {u.joint for u in unknowns} <= {None, *(range(N) if joints is None else joints)}
    space = FreeSpace(extended(MODEL, (Addition(effect),)), unknowns)
    assert np.all(np.any(space.directions != 0, axis=0))
    assert acts_at_joints(effect) == any(u.joint is not None for u in unknowns)


@pytest.mark.parametrize("effect", EFFECTS)
def test_a_fit_begins_at_a_size_only_where_no_slope_shows_the_way(effect: str) -> None:
    """What may have either sign begins absent; the baseline begins at its values."""
    model, added = extended(MODEL, (Addition(effect),)), unknowns_of(Addition(effect), N, 2)
    space = FreeSpace(model, [Free("capstan_friction"), *baseline_unknowns(model), *added])
    start, small = (beginning(space, len(added), part) for part in (USUAL, SMALL))
    np.testing.assert_allclose(small, start * SMALL / USUAL)
    assert not np.any(start[: -len(added)])
    for at, unknown in zip(start[-len(added) :], added, strict=True):
        parameter = effect_of(effect).parameters[unknown.name.split(".")[1]]
        one_sided = parameter.default is not None and parameter.default <= parameter.lower + 0.01 * parameter.typical
        assert (at > 0) == one_sided


def test_names() -> None:
    assert str(Addition("tip_payload")) == "tip_payload"
    assert str(Addition("rest_angle", (0, 3))) == "rest_angle@1,4"


def loss(precision: np.ndarray, found: np.ndarray, free: list[int]) -> float:
    """By least squares: the parabola at the best place with all but some joints at zero."""
    root = np.linalg.cholesky(precision).T
    left = root @ found
    if free:
        left = left - root[:, free] @ np.linalg.lstsq(root[:, free], left)[0]
    return float(left @ left / 2)


def loss_of_one(precision: np.ndarray, found: np.ndarray) -> float:
    """The same with one value for all joints, the weighted mean."""
    away = found - precision.sum(axis=0) @ found / precision.sum()
    return float(away @ precision @ away / 2)


@pytest.mark.parametrize("where", [(0,), (4,), (1, 3), (0, 1, 2), (0, 1, 2, 3, 4)])
def test_joints_that_act_are_named(where: tuple[int, ...]) -> None:
    random = np.random.default_rng(len(where))
    found = 0.02 * random.normal(size=N)
    found[list(where)] = 1 + 0.05 * np.arange(len(where))
    assert sorted(acting_joints(quadratic("rest_angle", found, 400 * np.eye(N)), "rest_angle")) == list(where)


@pytest.mark.parametrize("seed", range(20))
def test_with_the_joints_that_are_named_little_is_lost(seed: int) -> None:
    """Also where neighbours hang together, as the joints of an arm do.

    The last one named is needed, or one value for all joints explains as much.
    """
    random = np.random.default_rng(seed)
    mixed = random.normal(size=(N, N)) + 2 * np.eye(N)
    precision, found = 30 * mixed @ mixed.T, random.normal(size=N)
    named = acting_joints(quadratic("rest_angle", found, precision), "rest_angle")
    most = max(0.15 * loss(precision, found, []), 8.0)
    assert loss(precision, found, list(named)) < most + 1e-6
    if len(named) > 1:
        fewer = [list(some) for some in itertools.combinations(named, len(named) - 1)]
        is_needed = max(loss(precision, found, some) for some in fewer) >= most
        assert is_needed or (len(named) == N and loss_of_one(precision, found) < most)


def test_a_joint_brings_all_its_parameters_along() -> None:
    """Viscous and dry friction of one joint are one cause."""
    found = np.zeros(2 * N)
    found[[2, N + 2]] = 1.0
    assert acting_joints(quadratic("joint_friction", found, 400 * np.eye(2 * N)), "joint_friction") == (2,)


def test_a_joint_that_the_others_can_stand_in_for_is_not_needed() -> None:
    """Two joints of which the data see only the sum."""
    precision = 0.01 * np.eye(N)
    precision[:2, :2] += 400.0
    found = np.array([0.5, 0.5, 0.0, 0.0, 0.0])
    assert len(acting_joints(quadratic("rest_angle", found, precision), "rest_angle")) == 1


@pytest.mark.parametrize("seed", range(5))
def test_an_effect_that_all_joints_share_is_the_whole_arms(seed: int) -> None:
    """Neighbours stand in for each other: three of five could explain it nearly, at values that are not theirs."""
    apart = abs(np.arange(N)[:, None] - np.arange(N))
    precision = 400 * np.exp(-apart / 2)
    found = 1 + 0.05 * np.random.default_rng(seed).normal(size=N)
    some = [0, 2, 4]
    assert loss(precision, found, some) < 0.15 * loss(precision, found, [])
    assert set(acting_joints(quadratic("rest_angle", found, precision), "rest_angle")) == set(range(N))
    found[[1, 3]] = 0
    assert set(acting_joints(quadratic("rest_angle", found, precision), "rest_angle")) == set(some)
    assert len(acting_joints(quadratic("rest_angle", np.ones(N), 0.01 * np.eye(N) + 400), "rest_angle")) == 1


@pytest.mark.parametrize(("effect", "least"), [("rest_angle", 0.15), ("angle_offset", 0.005)])
def test_a_joint_is_named_for_its_part(effect: str, least: float) -> None:
    """More of it is asked where each recording has a value of its own, since all sensors may err alike."""
    for part, joints in ((0.8 * least, (0,)), (1.2 * least, (0, 1))):
        found = np.sqrt([1 - part, part, 0.0, 0.0, 0.0])
        assert acting_joints(quadratic(effect, found, 4e4 * np.eye(N)), effect) == joints
