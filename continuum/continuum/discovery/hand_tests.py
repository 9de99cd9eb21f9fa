"""Measurements by hand that would tell two possible sets of effects apart."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

from scipy.special import ndtri

from continuum.discovery.decision import CHANCE
from continuum.discovery.examination import Examination, Examined
from continuum.discovery.hand_misfit import SPREAD, value_and_sd
from continuum.discovery.power import POWER
from continuum.discovery.problem import ValueKey
from continuum.discovery.result import HandTest
from continuum.dynamics.effect_lookup import effect_named


def hand_tests(found: Examination, rivals: Sequence[Examined]) -> tuple[HandTest, ...]:
    """Values that two sets make different, the most telling first.

    What differs from recording to recording and is measured in one may be taken for what all share; such pairs are
    left out.

    Args:
        found: what was examined.
        rivals: two sets, or one.
    """
    if len(rivals) < 2:
        return ()
    keys = [{h.key for h in one.found.chosen if not h.is_refit} for one in rivals]
    rival_effects = {effect_named(h.effect).alike_in_all_runs for one in rivals for h in one.found.chosen}
    tests, enough = list[HandTest](), float(ndtri(1 - CHANCE / 2) + ndtri(POWER))
    for effect, name, joint in _measurable(keys[0] ^ keys[1], found.problem.structure.n):
        spec = effect_named(effect).parameters[name]
        (one, one_sd), (other, other_sd) = (value_and_sd(rival.fit, (effect, name, joint)) for rival in rivals)
        variance = spec.by_hand**2 + (SPREAD * one_sd) ** 2 + (SPREAD * other_sd) ** 2
        apart = abs(one - other) / variance**0.5
        if effect not in rival_effects:
            at = joint if joint >= 0 else None
            text = effect_named(effect).experiment
            tests.append(HandTest(effect, name, at, spec.unit, spec.by_hand, apart, apart > enough, text))
    return tuple(sorted(tests, key=lambda test: -test.apart))


def _measurable(keys: Set[tuple[str, tuple[int, ...] | None]], n: int) -> Iterator[ValueKey]:
    """Values that effects at places change and hands can measure, each once."""
    seen = set[ValueKey]()
    for effect, joints in sorted(keys, key=str):
        for name, spec in effect_named(effect).parameters.items():
            places = (joints or range(n)) if spec.per_joint else (-1,)
            for key in ((effect, name, joint) for joint in places):
                if spec.by_hand and not spec.per_recording and key not in seen:
                    seen.add(key)
                    yield key
