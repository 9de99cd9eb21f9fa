"""Effects that contend with each other are fitted from several beginnings: none loses by the valley it ended in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from discovery_fits import Fits, effects_of
from discovery_laws import trial

from continuum.discovery.other_beginnings import other_beginnings
from continuum.discovery.search import search, tell_nobody
from continuum.discovery.trial import Trial
from continuum.discovery.workers import Task
from continuum.identification.free import Free

STIFFNESS, FRICTION = Free("stiffness"), Free("coulomb_friction")
SIZE = Free("rest_angle.angle", 4)


def ended(effect: str, own: float, states: int, **values: float) -> Trial:
    unknowns = {"stiffness": STIFFNESS, "friction": FRICTION, "size": SIZE}
    return replace(
        trial(effect),
        unknowns=tuple(unknowns[name] for name in values),
        coordinates=np.array(list(values.values())),
        own=(np.full(4 + states, own),) * 2,
    )


def test_it_begins_with_its_effect_larger_and_with_all_else_as_in_the_best_ones_end() -> None:
    mine = ended("rest_angle", 1.0, 1, stiffness=0.2, friction=0.4, size=-0.04)
    best = ended("angle_offset", 2.0, 0, friction=0.5, stiffness=0.3, size=9.0)
    larger, as_measured, beside = other_beginnings(mine, best)
    np.testing.assert_allclose(larger.coordinates, [0.2, 0.4, -0.06])
    np.testing.assert_array_equal(as_measured.coordinates, larger.coordinates)
    assert as_measured.own == ()
    assert larger.own is mine.own
    np.testing.assert_allclose(beside.coordinates, [0.3, 0.5, -0.04])
    for own in beside.own:
        np.testing.assert_array_equal(own, [2, 2, 2, 2, 1])  # states of an effect that the best one lacks stay
    assert larger.unknowns == beside.unknowns == mine.unknowns
    np.testing.assert_allclose(mine.coordinates, [0.2, 0.4, -0.04])


def test_the_best_one_begins_with_its_effect_larger_alone() -> None:
    best = ended("rest_angle", 1.0, 0, stiffness=0.2, size=0.1)
    larger, as_measured = other_beginnings(best, best)
    for one in (larger, as_measured):
        np.testing.assert_allclose(one.coordinates, [0.2, 0.15])
    assert larger.own is best.own
    assert as_measured.own == ()


class Stuck(Fits):
    """A tilt ends in a wrong valley, unless it begins where itself or another one ended."""

    def fitted(self, task: Task) -> Trial:
        made = super().fitted(task)
        begins_again = not task.is_look and task.near is not None and task.near.extension == task.extension
        if effects_of(task.extension) != ["base_tilt"] or (begins_again and not task.find_joints):
            return made
        return replace(trial("base_tilt", bad=0.1, seed=1), cost=2500.0)


def test_one_that_ended_in_a_wrong_valley_has_not_lost_to_its_rival() -> None:
    fits = Stuck({(): 0.3, ("tip_payload",): 0.04, ("base_tilt",): 0.0})
    _, rounds = search(fits, ("tip_payload", "base_tilt"), tell_nobody)
    assert effects_of(rounds[0].best.extension) == ["base_tilt"]
    assert fits.times("base_tilt") > fits.times("tip_payload") > 2


def test_one_without_a_rival_is_fitted_once() -> None:
    fits = Fits({(): 0.3, ("tip_payload",): 0.0})
    search(fits, ("tip_payload", "base_tilt"), tell_nobody)
    assert fits.times("tip_payload") == 3  # looked at, led, and found its joints
