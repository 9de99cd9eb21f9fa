"""A delay of half a row is how tensions go on between rows, not a late sensor."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from identification_laws import BENDS, recorded, small_simulator, white_noise

from continuum.discovery.candidate import Addition
from continuum.discovery.evidence import is_adequate
from continuum.discovery.question import Question
from continuum.discovery.rows_asked_again import with_better_rows
from continuum.discovery.trial import Trial, fit_extension, judged
from continuum.discovery.workers import first_look, make
from continuum.dynamics.tensions import Tensions
from continuum.identification.free import Free

SIMULATOR = small_simulator()
FREE = tuple(Free(name) for name in ("stiffness", "viscous_friction", "coulomb_friction"))
TIMES = np.arange(0, 0.7, 1 / 120)
SMOOTH = Tensions(TIMES, 6 * np.maximum([np.sin(14 * TIMES), -np.sin(14 * TIMES)], 0.0).T)
DELAY = (Addition("sensor_delay"),)


def asked(held: bool, truly_held: bool) -> Question:
    random = np.random.default_rng(4)
    truth = replace(SMOOTH, held=truly_held)
    runs = [recorded(SIMULATOR, bend, random, tensions=truth) for bend in BENDS[:2]]
    taken = tuple(replace(run, tensions=replace(SMOOTH, held=held)) for run in runs)
    return Question(SIMULATOR.model, FREE, taken, white_noise())


def fitted(question: Question, extension: tuple[Addition, ...]) -> Trial:
    return judged(extension, fit_extension(question, extension))


def test_a_late_sensor_that_other_rows_make_needless_is_none() -> None:
    question = asked(held=False, truly_held=True)
    best = fitted(question, DELAY)
    assert best.amounts[-1] == pytest.approx(0.5 / 120, rel=0.2)
    found = with_better_rows(question, best)
    assert found is not None
    other, rest = found
    assert DELAY[0] not in rest.extension
    assert all(run.tensions is not None and run.tensions.held for run in other.recordings)


def test_rows_that_are_right_stay() -> None:
    for held in (True, False):
        question = asked(held=held, truly_held=held)
        wrong = replace(question, model=question.model.with_values({"rest_angle": 0.05}))  # windows stay unexplained
        best = fitted(wrong, ())
        assert not is_adequate(best)
        assert with_better_rows(wrong, best) is None


def test_rows_that_are_wrong_are_turned_without_any_cause() -> None:
    question = asked(held=False, truly_held=True)
    best = fitted(question, ())
    assert not is_adequate(best)
    found = with_better_rows(question, best)
    assert found is not None
    other, trial = found
    assert trial.cost == pytest.approx(fitted(other, ()).cost, rel=0.01)
    assert trial.cost < 0.9 * best.cost


@pytest.mark.parametrize("delay", [0.008, 0.015, 0.02])
@pytest.mark.parametrize("held", [True, False])
def test_a_true_delay_is_found_and_stays(held: bool, delay: float) -> None:
    """Joints feel when held tensions jump, so that delays which are wrong by whole rows explain much as well."""
    simulator = small_simulator("sensor_delay")
    random, late = np.random.default_rng(4), {"sensor_delay.delay": delay}
    runs = tuple(recorded(simulator, bend, random, late, tensions=replace(SMOOTH, held=held)) for bend in BENDS[:2])
    question = Question(SIMULATOR.model, FREE, runs, white_noise())
    look = make(question, first_look(DELAY, fitted(question, ())))
    best = judged(DELAY, fit_extension(question, DELAY, look))
    assert best.amounts[-1] == pytest.approx(delay, rel=0.05)
    assert with_better_rows(question, best) is None


def test_of_two_late_effects_the_one_that_other_rows_make_needless_turns_them() -> None:
    simulator = small_simulator("sensor_delay")
    random, late = np.random.default_rng(4), {"sensor_delay.delay": 0.02}
    runs = tuple(recorded(simulator, bend, random, late, tensions=replace(SMOOTH, held=True)) for bend in BENDS[:2])
    taken = tuple(replace(run, tensions=replace(SMOOTH, held=False)) for run in runs)
    question = Question(SIMULATOR.model, FREE, taken, white_noise())
    best = fitted(question, (Addition("actuator_lag"), *DELAY))
    found = with_better_rows(question, best)
    assert found is not None
    other, rest = found
    assert len(rest.extension) == 1
    assert all(run.tensions is not None and run.tensions.held for run in other.recordings)
