"""Measurements by hand, and removals, that would distinguish two possible sets of effects."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

from scipy.special import ndtri

from continuum.discovery.decision import CHANCE
from continuum.discovery.examination import Examination, Examined
from continuum.discovery.fit_result import Fitted
from continuum.discovery.power import POWER
from continuum.discovery.problem import ValueKey
from continuum.discovery.result import HandTest, Removal
from continuum.discovery.zeros_by_hand import WIDENING
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.parameters import ByHand
from continuum.languages import Message


def hand_tests(found: Examination, rivals: Sequence[Examined]) -> tuple[HandTest, ...]:
    """Return the values about which two sets differ, the most informative first.

    A per-run value that is measured once can be mistaken for one that all recordings share; such pairs are left out.

    Args:
        found: result of the search.
        rivals: two sets, or one.
    """
    if len(rivals) < 2:
        return ()
    keys = [{h.key for h in one.found.chosen} for one in rivals]
    taken_for = {effect_named(h.effect).alike_in_all_runs for one in rivals for h in one.found.chosen}
    known, enough = {one.key for one in found.problem.measured}, float(ndtri(1 - CHANCE / 2) + ndtri(POWER))
    tests = list[HandTest]()
    for key, by_hand in _measurable(keys[0] ^ keys[1], found.problem.structure.n):
        effect, name, joint = key
        if effect in taken_for or key in known:
            continue
        (one, one_sd), (other, other_sd) = (value_and_sd(rival.fit, key) for rival in rivals)
        variance = by_hand.sd**2 + (WIDENING * one_sd) ** 2 + (WIDENING * other_sd) ** 2
        apart, unit = abs(one - other) / variance**0.5, effect_named(effect).parameters[name].unit
        where = joint if joint >= 0 else None
        how = by_hand.how[:1].lower() + by_hand.how[1:]
        text = by_hand.how if where is None else Message("At joint {joint}: {how}", joint=joint + 1, how=Message(how))
        tests.append(HandTest(effect, name, where, unit, by_hand.sd, apart, apart > enough, text))
    return tuple(sorted(tests, key=lambda test: -test.apart))


def removals(rivals: Sequence[Examined]) -> tuple[Removal, ...]:
    """Return the effects of only one of two sets that can be taken off the arm."""
    names = [{h.effect for h in one.found.chosen} for one in rivals]
    per_run = sorted(names[0] ^ names[1]) if len(names) > 1 else []
    return tuple(Removal(name, text) for name in per_run if (text := effect_named(name).removal))


def value_and_sd(fit: Fitted, key: ValueKey) -> tuple[float, float]:
    """Return a set's estimate of a value and its standard deviation; zeros if the set does not have the value."""
    effect, name, joint = key
    active, variance = fit.state.active.get(effect, {}), 0.0
    value = float(active[name][max(joint, 0)]) if name in active else fit.state.shared.get(key, 0.0)
    for one, sd in zip(fit.unknowns.common, fit.sd, strict=True):
        if key in one.places:
            variance += float(((value if one.is_log else one.places[key]) * sd) ** 2)
    return value, variance**0.5


def _measurable(keys: Set[tuple[str, tuple[int, ...] | None]], n: int) -> Iterator[tuple[ValueKey, ByHand]]:
    """Yield the values of effects at places that can be measured by hand, each once."""
    seen = set[ValueKey]()
    for effect, joints in sorted(keys, key=str):
        for name, spec in effect_named(effect).parameters.items():
            places = (joints or range(n)) if spec.per_joint else (-1,)
            for key in ((effect, name, joint) for joint in places):
                if spec.by_hand is not None and not spec.per_recording and key not in seen:
                    seen.add(key)
                    yield key, spec.by_hand
