"""A base remounted at the same angle for every run is a tilted one: never its rival, and not named instead of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from discovery_fits import Fits, effects_of
from discovery_laws import trial
from identification_laws import BENDS, recorded, small_simulator, white_noise

from continuum.discovery.candidate import Addition
from continuum.discovery.price_of_own import OneForAll
from continuum.discovery.question import Question
from continuum.discovery.search import search, tell_nobody
from continuum.discovery.special_cases import without_special_cases
from continuum.discovery.trial import TOLERANCES, Trial, fit_extension, judged
from continuum.discovery.workers import Task
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.identification.free import Free

TILT, PAYLOAD = trial("base_tilt"), trial("tip_payload")
REMOUNTED = trial("remounted_base")
ALIKE = replace(REMOUNTED, one_for_all=OneForAll(3, 0.5))


def test_values_that_are_alike_in_all_runs_are_the_other_effects_to_explain() -> None:
    assert without_special_cases([ALIKE, TILT, PAYLOAD]) == [TILT, PAYLOAD]
    assert without_special_cases([TILT, REMOUNTED]) == [TILT, REMOUNTED]
    assert without_special_cases([ALIKE, PAYLOAD]) == [ALIKE, PAYLOAD]  # the other one is not there to explain them
    zero = replace(trial("angle_offset"), one_for_all=OneForAll(3, 0.5))
    assert without_special_cases([zero, TILT]) == [zero, TILT]


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
        return replace(made, one_for_all=OneForAll(3, 0.5)) if is_it else made


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
