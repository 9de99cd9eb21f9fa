"""What belongs to each recording is paid for: for each, or as one where it may be the same in all."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from identification_laws import BENDS, N, recorded, small_simulator, white_noise

from continuum.discovery.candidate import Addition
from continuum.discovery.held_out import held_out_misfits
from continuum.discovery.information import effective_number, information_gain
from continuum.discovery.one_value import with_one_value
from continuum.discovery.price_of_own import own_prices
from continuum.discovery.question import Question
from continuum.discovery.trial import TOLERANCES, fit_extension, judged
from continuum.discovery.workers import Task, make
from continuum.identification.fit import Fit, fit
from continuum.identification.free import Free

OFFSET = "angle_offset.offset"
EACH = tuple(Free(OFFSET, joint, run) for run in range(3) for joint in range(N))
ONE = tuple(Free(OFFSET, joint) for joint in range(N))


@lru_cache
def fitted(unknowns: tuple[Free, ...], *offsets: float) -> Fit:
    """Of runs whose first joint is read so much too large [rad]."""
    simulator, random = small_simulator("angle_offset", TOLERANCES), np.random.default_rng(1)
    truth = [{OFFSET: np.array([offset, *(N - 1) * [0.0]])} for offset in offsets]
    runs = [recorded(simulator, bend, random, one) for bend, one in zip(BENDS, truth, strict=False)]
    return fit(simulator, runs, white_noise(), unknowns, iterations=30)


def errors_of_a_run(found: Fit) -> int:
    return int(found.runs[0].errors_by_window.sum())


@pytest.mark.parametrize("offsets", [(0.05, -0.03, 0.01), (0.0, 0.04, 0.08)])
def test_values_that_differ_are_paid_for_each(offsets: tuple[float, ...]) -> None:
    found = fitted(EACH, *offsets)
    paid, saved = own_prices(found)
    assert paid == pytest.approx(3 * [N * np.log(errors_of_a_run(found))])
    assert not saved
    for predicted, misfits, price in zip(held_out_misfits(found), found.misfits, paid, strict=True):
        assert predicted.sum() == pytest.approx(misfits.sum() + price, rel=1e-6)


@pytest.mark.parametrize("offset", [0.0, 0.05])
def test_what_may_be_the_same_is_paid_for_as_one_and_as_what_it_takes_to_be_one(offset: float) -> None:
    found, of_one = fitted(EACH, *3 * [offset]), fitted(ONE, *3 * [offset])
    paid, by_effect = own_prices(found)
    saved = by_effect["angle_offset"]
    assert saved.unknowns == 2 * N
    assert 0 < saved.misfit < 25  # chi squared of 4
    assert saved.misfit == pytest.approx(2 * (of_one.cost - found.cost), abs=2.0)  # by a fit of one value
    assert paid.sum() == pytest.approx(N * np.log(3 * errors_of_a_run(found)) + saved.misfit)
    assert np.ptp(paid) == 0


@pytest.mark.parametrize("seed", range(5))
def test_what_it_takes_to_be_one_is_the_least_misfit_of_all_that_are(seed: int) -> None:
    """The others follow: by minimising the parabola over what is shared and one value for each joint."""
    random, unknowns = np.random.default_rng(seed), (Free("stiffness"), *EACH)
    root = random.normal(size=(20, len(unknowns)))
    ended = 0.3 * random.normal(size=len(unknowns))
    one_value = np.zeros((len(unknowns), 1 + N))
    one_value[0, 0] = 1.0
    one_value[1:, 1:] = np.tile(np.eye(N), (3, 1))
    least = np.linalg.lstsq(root @ one_value, root @ ended)[1][0]
    run = SimpleNamespace(errors_by_window=np.full(10, 1e9))
    found = SimpleNamespace(
        runs=3 * [run], space=SimpleNamespace(unknowns=unknowns), coordinates=ended, information=root.T @ root
    )
    saved = own_prices(cast(Fit, found))[1]["angle_offset"]
    assert saved.unknowns == 2 * N  # so many errors make each unknown dear
    assert saved.misfit == pytest.approx(least)


def test_a_shared_unknown_costs_no_run_anything() -> None:
    paid, saved = own_prices(fitted(ONE, 0.05, 0.05, 0.05))
    assert not paid.any()
    assert not saved


def test_the_criterion_counts_what_may_be_the_same_once() -> None:
    trial = judged((), fitted(EACH, 0.05, 0.05, 0.05))
    plain = replace(trial, saved={})
    saved = trial.one_for_all
    dearer = information_gain(trial, plain)
    assert dearer == pytest.approx(saved.unknowns * np.log(effective_number(trial)) / 2 - saved.misfit / 2)
    assert dearer > 0


def test_one_value_is_the_median_of_each_joint() -> None:
    trial = judged((), fitted(EACH, 0.05, -0.03, 0.01))
    own = with_one_value(trial).coordinates.reshape(3, N)
    np.testing.assert_array_equal(own, np.median(trial.coordinates.reshape(3, N), axis=0) + np.zeros((3, 1)))


def test_a_fit_that_got_stuck_goes_on_from_one_value() -> None:
    """After two iterations it is as good as stuck: two more from one value of all recordings do better."""
    simulator, random = small_simulator("angle_offset", TOLERANCES), np.random.default_rng(1)
    runs = [recorded(simulator, bend, random, {OFFSET: np.array([0.05, 0.0])}) for bend in BENDS[:3]]
    question = Question(small_simulator().model, (Free("stiffness"),), runs, white_noise())
    extension = (Addition("angle_offset", (0,)),)
    stuck = judged(extension, fit_extension(question, extension, iterations=2))
    assert stuck.one_for_all.unknowns
    ended = judged(extension, fit_extension(question, extension, with_one_value(stuck), iterations=2))
    assert ended.cost < stuck.cost
    made = make(question, Task(extension, None, 2))
    assert made.cost == ended.cost
    np.testing.assert_array_equal(made.coordinates, ended.coordinates)
    assert made.simulations == stuck.simulations + ended.simulations
