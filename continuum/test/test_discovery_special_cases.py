"""A base remounted at the same angle for every run is a tilted one: never its rival, and not named instead of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from discovery_fits import Fits, effects_of
from discovery_laws import trial
from identification_laws import BENDS, recorded, small_simulator, white_noise

from continuum.discovery.candidate import Addition
from continuum.discovery.diagnose import diagnose
from continuum.discovery.price_of_own import OneForAll
from continuum.discovery.question import Question
from continuum.discovery.search import search, tell_nobody
from continuum.discovery.special_cases import without_special_cases, worth_trying
from continuum.discovery.trial import TOLERANCES, Trial, fit_extension, judged
from continuum.discovery.workers import Task
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.identification.dataset import Dataset
from continuum.identification.free import Free

TILT, PAYLOAD = trial("base_tilt"), trial("tip_payload")
REMOUNTED = trial("remounted_base")


def alike(one: Trial, misfit: float = 0.5, effect: str = "remounted_base") -> Trial:
    """Of four runs, in which it costs a misfit to take the effect's values for one."""
    return replace(one, saved={effect: OneForAll(3, misfit)})


def test_values_that_are_alike_in_all_runs_are_the_other_effects_to_explain() -> None:
    same = alike(REMOUNTED)
    assert without_special_cases([same, TILT, PAYLOAD]) == [TILT, PAYLOAD]
    assert without_special_cases([TILT, REMOUNTED]) == [TILT, REMOUNTED]
    assert without_special_cases([same, PAYLOAD]) == [same, PAYLOAD]  # the other one is not there to explain them
    zero = alike(trial("angle_offset"), effect="angle_offset")
    assert without_special_cases([zero, TILT]) == [zero, TILT]


def test_values_that_chance_does_not_take_so_far_apart_are_not_alike() -> None:
    """However dear one for each run is: at 12 a chi squared of 3 has a chance of 0.7 %, at 11 one of 1.2 %."""
    apart = alike(REMOUNTED, 12.0)
    assert without_special_cases([apart, TILT]) == [apart, TILT]
    assert without_special_cases([alike(REMOUNTED, 11.0), TILT]) == [TILT]


def test_one_that_explains_far_more_than_the_other_is_not_that_one() -> None:
    better, worse = alike(REMOUNTED), trial("base_tilt", misfit=1.3)
    assert without_special_cases([better, worse]) == [better, worse]


def test_what_an_earlier_effect_has_alike_says_nothing_of_the_last_one() -> None:
    both = alike(trial("angle_offset", "remounted_base"), effect="angle_offset")
    other = trial("angle_offset", "base_tilt")
    assert without_special_cases([both, other]) == [both, other]


def test_in_one_run_alone_both_are_one_thing_and_the_simpler_one_is_tried() -> None:
    names = ["base_tilt", "remounted_base", "tip_payload"]
    assert worth_trying(names, 1) == ["base_tilt", "tip_payload"]
    assert worth_trying(names, 2) == names
    assert worth_trying(names[1:], 1) == names[1:]


@pytest.mark.parametrize("runs", [1, 2])
def test_a_diagnosis_of_one_run_tries_the_simpler_one(runs: int) -> None:
    simulator, random = small_simulator("base_tilt", TOLERANCES), np.random.default_rng(4)
    data = [recorded(simulator, bend, random, {"base_tilt.angle": 0.1}, name=f"r{i}")
            for i, bend in enumerate(BENDS[:runs])]  # fmt: skip
    found = diagnose(
        Dataset(tuple(data)), small_simulator().model, processes=1, effects=("base_tilt", "remounted_base")
    )
    looked_at = {effect for one in found.rounds[0].looks for effect in effects_of(one.extension)}
    assert looked_at == ({"base_tilt"} if runs == 1 else {"base_tilt", "remounted_base"})


def test_a_base_that_the_model_has_askew_may_hang_otherwise_in_one_run() -> None:
    """What the model has keeps its value."""
    simulator = small_simulator("base_tilt", TOLERANCES)
    run = recorded(simulator, BENDS[0], np.random.default_rng(4), {"base_tilt.angle": 0.17})
    model = simulator.model.with_values({"base_tilt.angle": 0.05})
    found = diagnose(Dataset((run,)), model, processes=1, effects=("base_tilt", "remounted_base"))
    assert {effect for one in found.rounds[0].looks for effect in effects_of(one.extension)} == {"remounted_base"}


def test_what_an_effect_is_then_is_in_the_library_and_has_one_value() -> None:
    named = {name: other for name in effect_names() if (other := effect_named(name).alike_in_all_runs)}
    assert named["remounted_base"] == "base_tilt"
    for name, other in named.items():
        assert any(parameter.per_recording for parameter in effect_named(name).parameters.values())
        assert not any(parameter.per_recording for parameter in effect_named(other).parameters.values())


class Remounting(Fits):
    """A remounted base whose values are alike in all runs."""

    def fitted(self, task: Task) -> Trial:
        made = super().fitted(task)
        is_it = effects_of(task.extension) == ["remounted_base"]
        return alike(made) if is_it else made


def test_a_round_names_the_simpler_of_both() -> None:
    fits = Remounting({(): 0.3, ("remounted_base",): 0.0, ("base_tilt",): 0.01})
    _, rounds = search(fits, ("remounted_base", "base_tilt"), tell_nobody)
    assert effects_of(rounds[0].best.extension) == ["base_tilt"]
    assert [effects_of(one.extension) for one in rounds[0].leaders] == [["base_tilt"]]


@pytest.mark.parametrize(("tilts", "is_alike"), [((0.08, 0.08, 0.08), True), ((0.08, -0.05, 0.02), False)])
def test_the_data_tell_whether_a_base_was_remounted(tilts: tuple[float, ...], is_alike: bool) -> None:
    simulator, random = small_simulator("base_tilt", TOLERANCES), np.random.default_rng(2)
    runs = [
        recorded(simulator, bend, random, {"base_tilt.angle": tilt})
        for bend, tilt in zip(BENDS[:3], tilts, strict=True)
    ]
    question = Question(small_simulator().model, (Free("stiffness"),), runs, white_noise())
    extension = (Addition("remounted_base"),)
    fitted = fit_extension(question, extension)
    found = judged(extension, fitted)
    assert bool(found.one_for_all.unknowns) is is_alike
    own = [i for i, unknown in enumerate(found.unknowns) if unknown.recording is not None]
    np.testing.assert_allclose(found.amounts[own], tilts, atol=0.01)
