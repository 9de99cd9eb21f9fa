"""A fit begins where an effect promises most, of the beginnings that it names."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from identification_laws import BENDS, recorded, small_simulator, white_noise

from continuum.discovery import workers
from continuum.discovery.candidate import SMALL, USUAL, Addition, Extension
from continuum.discovery.evidence import is_adequate
from continuum.discovery.likeliest_beginning import with_likeliest_beginning
from continuum.discovery.question import Question
from continuum.discovery.trial import Trial, fit_extension, judged
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.tensions import Tensions
from continuum.identification.fit import Fit
from continuum.identification.free import Free
from continuum.identification.window_settling import STEPS

FREE = tuple(Free(name) for name in ("stiffness", "viscous_friction", "coulomb_friction"))
TIMES = np.arange(0, 0.7, 1 / 120)
SWINGING = Tensions(TIMES, 8 * np.maximum([np.sin(14 * TIMES), -np.sin(14 * TIMES)], 0.0).T)
SLACK = (Addition("slack_cable"),)


def question_about(slack: float, least: float) -> Question:
    simulator, values = small_simulator("slack_cable"), {"slack_cable.slack": slack, "slack_cable.least": least}
    random = np.random.default_rng(8)
    runs = tuple(recorded(simulator, bend, random, values, tensions=SWINGING) for bend in BENDS[:2])
    return Question(small_simulator().model, FREE, runs, white_noise())


@pytest.mark.parametrize(("slack", "least"), [(0.006, 0.9), (0.014, 0.35), (0.013, 2.6)])
def test_a_fit_of_loose_cables_begins_at_the_nearest_of_the_beginnings(slack: float, least: float) -> None:
    question = question_about(slack, least)
    without = judged((), fit_extension(question, ()))
    begun = with_likeliest_beginning(question, SLACK, without, 3)
    assert values_of(begun)["least"] == min((0.1, 0.3, 1.0, 3.0), key=lambda other: abs(np.log(other / least)))
    assert values_of(begun)["slack"] == min((0.005, 0.015), key=lambda other: abs(np.log(other / slack)))
    fitted = fit_extension(question, SLACK, begun, to_the_end=True)
    from_the_truth = fit_extension(question, SLACK, moved_to(begun, slack=slack, least=least), to_the_end=True)
    assert fitted.cost < from_the_truth.cost + 1.0  # as likely: less slack, of motors that hesitate for longer
    found = values_of(judged(SLACK, fitted))
    assert found["slack"] == pytest.approx(slack, rel=0.15)
    assert found["least"] == pytest.approx(least, rel=0.3)  # passed in a millisecond, as a little slack is


def moved_to(begun: Trial, **values: float) -> Trial:
    """The start of a fit with other values of the effect."""
    parameters, coordinates = effect_named("slack_cable").parameters, begun.coordinates.copy()
    for i, unknown in enumerate(begun.unknowns):
        name = unknown.name.removeprefix("slack_cable.")
        if name in values:
            coordinates[i] = (values[name] - (parameters[name].default or 0.0)) / (parameters[name].typical or 1.0)
    return replace(begun, coordinates=coordinates)


def values_of(trial: Trial) -> dict[str, float]:
    """Of the effect, by name."""
    parameters = effect_named("slack_cable").parameters
    moved = {unknown.name.split(".")[-1]: float(by) for unknown, by in zip(trial.unknowns, trial.amounts, strict=True)}
    return {name: (parameters[name].default or 0.0) + by for name, by in moved.items() if name in parameters}


def test_effects_that_name_no_beginnings_begin_as_always() -> None:
    question = question_about(0.0, 0.3)
    without = judged((), fit_extension(question, ()))
    assert with_likeliest_beginning(question, (Addition("quadratic_drag"),), without, 3) is without
    assert with_likeliest_beginning(question, (), without, 3) is without


def test_what_was_fitted_is_not_begun_anew() -> None:
    question = question_about(0.012, 0.9)
    without = judged((), fit_extension(question, ()))
    best = judged(SLACK, fit_extension(question, SLACK, with_likeliest_beginning(question, SLACK, without, 3)))
    assert with_likeliest_beginning(question, SLACK, best, 3) is best


@pytest.mark.parametrize("is_look", [True, False])
def test_windows_begun_afresh_forget_where_the_start_has_them(is_look: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    question = question_about(0.0, 0.3)
    without = judged((), fit_extension(question, ()))
    begun: list[Trial] = []

    def fitted(question: Question, extension: Extension, near: Trial, *options: int, **named: float) -> Fit:
        begun.append(near)
        return fit_extension(question, extension, near, *options, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(workers, "fit_extension", fitted)
    for afresh in (True, False):
        workers.make(question, workers.Task((), without, 1, is_look=is_look, afresh=afresh))
    assert [near.own for near in begun] == [(), without.own]
    assert begun[0].unknowns == without.unknowns


@pytest.mark.parametrize("closely", [True, False])
def test_close_looks_find_beginnings_of_windows_as_well_as_fits_do(
    closely: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    question = question_about(0.0, 0.3)
    without = judged((), fit_extension(question, ()))
    steps: list[object] = []

    def fitted(question: Question, extension: Extension, near: Trial, *options: int, **named: float) -> Fit:
        steps.append(options[2])
        return fit_extension(question, extension, near, *options, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(workers, "fit_extension", fitted)
    workers.make(question, workers.first_look((), without, 1, closely=closely))
    assert [one == STEPS for one in steps] == [closely]


DRAG = (Addition("quadratic_drag"),)


def test_looks_begin_small_where_the_model_explains_the_data_nearly(monkeypatch: pytest.MonkeyPatch) -> None:
    question = question_about(0.0, 0.3)
    without = judged((), fit_extension(question, ()))
    wrong = replace(without, held_out=tuple(9 * run for run in without.held_out))
    assert is_adequate(without)
    parts: list[float] = []

    def fitted(question: Question, extension: Extension, near: Trial, *options: int, part: float) -> Fit:
        parts.append(part)
        return fit_extension(question, extension, near, *options, part=part)

    monkeypatch.setattr(workers, "fit_extension", fitted)
    for near in (without, wrong):
        workers.make(question, workers.first_look(DRAG, near, 1))
    assert parts == [SMALL, USUAL]
