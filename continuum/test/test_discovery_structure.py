"""What a missing torque goes with: found where it does, and no more often by chance than the p-value says."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from continuum.discovery.residual_torque import ResidualTorque
from continuum.discovery.structure_tests import structure_tests
from continuum.discovery.turns import way_since_turn
from continuum.dynamics.tensions import LET_GO

WINDOWS, JOINTS = 60, 2


def a_run(random: np.random.Generator, torque: Callable[[ResidualTorque], np.ndarray]) -> ResidualTorque:
    """Slow wandering of joints, cables and loads, each by itself, and torque as given with some more."""

    def wander(columns: int) -> np.ndarray:
        return lfilter([1.0], [1.0, -0.8], random.normal(size=(WINDOWS, columns)), axis=0)

    theta, shape = 0.2 * wander(JOINTS), (WINDOWS, JOINTS)
    run = ResidualTorque(
        "run", np.arange(WINDOWS) / 10, np.zeros(shape), np.full(shape, 1e-3), theta, wander(JOINTS),
        np.abs(wander(2)), 5 + np.abs(wander(JOINTS)), way_since_turn(theta),
    )  # fmt: skip
    signal = torque(run)
    return replace(run, torque=signal / np.std(signal) + 0.3 * wander(JOINTS))


def runs(torque: Callable[[ResidualTorque], np.ndarray], seed: int = 0, count: int = 3) -> list[ResidualTorque]:
    random = np.random.default_rng(seed)
    return [a_run(random, torque) for _ in range(count)]


def alone_by(random: np.random.Generator) -> Callable[[ResidualTorque], np.ndarray]:
    """A torque that wanders by itself, as alike from window to window as what it is compared with."""
    return lambda r: lfilter([1.0], [1.0, -0.8], random.normal(size=r.theta.shape), axis=0)


def direction(r: ResidualTorque) -> np.ndarray:
    return np.tanh(r.theta_rate / 0.05)


@pytest.mark.parametrize(
    ("against", "torque"),
    [
        ("position", lambda r: r.theta),
        ("direction of motion", direction),
        ("speed", lambda r: r.theta_rate),
        ("difference of tensions", lambda r: np.tile(r.tension[:, :1] - r.tension[:, 1:], JOINTS)),
        ("direction times tension", lambda r: direction(r) * r.tension.sum(axis=1, keepdims=True) ** 2),
        ("direction times load", lambda r: direction(r) * (r.load - 4.5) ** 3),
        ("direction soon after a reversal", lambda r: direction(r) * np.exp(-r.way_since_turn / 0.03)),
        ("time within the run", lambda r: np.tile(r.times[:, None], JOINTS)),
    ],
)
def test_what_a_torque_goes_with_is_told(against: str, torque: Callable[[ResidualTorque], np.ndarray]) -> None:
    tests = structure_tests(runs(torque), np.random.default_rng(1))
    for joint in range(JOINTS):
        mine = [test for test in tests if test.joint == joint]
        (one,) = [test for test in mine if test.against == against]
        assert one.p_value < 0.01
        assert one.correlation > 0.95 * max(test.correlation for test in mine)  # a direction has the ranks of its speed


def test_what_goes_with_the_order_of_the_runs_is_told() -> None:
    alone = runs(alone_by(np.random.default_rng(2)), count=6)
    drifting = [replace(run, torque=run.torque + 1.5 * i) for i, run in enumerate(alone)]
    surest = structure_tests(drifting, np.random.default_rng(1))[:JOINTS]
    assert [test.against for test in surest] == ["order of the runs"] * JOINTS
    assert all(test.p_value < 0.01 for test in surest)


def test_chance_is_as_rare_as_it_is_said_to_be() -> None:
    p_values = []
    for seed in range(8):
        alone = runs(alone_by(np.random.default_rng(100 + seed)), seed)
        p_values += [test.p_value for test in structure_tests(alone, np.random.default_rng(seed))]
    assert len(p_values) > 150
    assert 0.02 < np.mean(np.array(p_values) < 0.05) < 0.09


def test_joints_of_which_the_data_tell_nothing_go_with_nothing() -> None:
    untold = [replace(run, deviation=np.full(run.theta.shape, 1.0)) for run in runs(lambda r: r.theta)]
    assert structure_tests(untold, np.random.default_rng(0)) == []


def test_windows_that_tell_nothing_have_no_say() -> None:
    """Whether a window tells a torque goes with much: joints that stick show only that it is small."""
    shown = runs(lambda r: r.theta)
    spoilt = [
        replace(
            run,
            torque=np.where(run.times[:, None] > run.times.mean(), 1e3, run.torque),
            deviation=np.where(run.times[:, None] > run.times.mean(), 1.0, run.deviation),
        )
        for run in shown
    ]
    against = {t.against: t for t in structure_tests(spoilt, np.random.default_rng(0)) if t.joint == 0}
    assert against["position"].correlation > 0.8
    assert against["position"].p_value < 0.01


def test_a_joint_that_misses_little_beside_another_is_not_compared() -> None:
    little = [
        replace(run, torque=run.torque * [1.0, *[0.05] * (run.torque.shape[1] - 1)]) for run in runs(lambda r: r.theta)
    ]
    assert {test.joint for test in structure_tests(little, np.random.default_rng(0))} == {0}


def test_cables_that_were_let_go_are_no_tension() -> None:
    """Their tension is a mark below zero; times the direction of motion it would be that direction again."""
    gone = [replace(run, tension=np.full(run.tension.shape, LET_GO)) for run in runs(lambda r: np.sign(r.theta_rate))]
    assert not [test for test in structure_tests(gone, np.random.default_rng(0)) if "tension" in test.against]
