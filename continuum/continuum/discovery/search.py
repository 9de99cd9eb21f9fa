"""Search for sets of effects with a high posterior: screen, refine, screen for a second effect.

A set is brought to its own optimum before a second effect is looked for beside it: an unconverged trajectory makes
effects look present that only repair the linearisation.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.decision import ALIKE, PRICE
from continuum.discovery.evidence import Evidence, Set
from continuum.discovery.gauss_newton import moved
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.problem import Linearised, Problem, State, linearise, near

MOST = 2
"""Effects that are named together at most: three would need more runs than a laboratory makes."""
NEGLIGIBLE = 0.0125
"""Missing torque that no model of an arm does without, as a part of the torque that moves it."""
RATIO = (1.6, 1.25, 1.1)
"""By which values of effects that are not linear are changed for differences, iteration by iteration."""
ITERATIONS = 3
"""Gauss-Newton steps of one set, at most."""
FAMILIES = 6
"""Effects that are refined at most."""
LONG_SHOT = 0.2
"""Part of the best single effect's gain from which others are refined while none explains the data."""
RUNNER_UP = 0.6
"""Part of the best single effect's gain from which another is refined too: screening ranks to within a third."""
_EXCHANGES = 3  # times that a second effect is added, or one of two exchanged
PROMISING = 2  # effects that are fitted because open-loop sensitivities promise most of them
_ALTERNATIVES = 2  # effects that are refined in the place of each of two

type Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class Found:
    """A set of effects at its own optimum.

    Attributes:
        lin: the state about the set, linearised.
        chosen: the set.
    """

    lin: Linearised
    chosen: Set

    @property
    def log_evidence(self) -> float:
        """Of the set."""
        return self.lin.evidence.total(self.chosen, with_constraints=True)

    @property
    def key(self) -> frozenset[object]:
        """Effects of the set with their places."""
        return frozenset(h.key for h in self.chosen)

    def with_only(self, one: Hypothesis) -> Found:
        """A part of the set, about the same state without the other effects."""
        state = self.lin.state
        active = {effect: own for effect, own in state.active.items() if effect == one.effect}
        return Found(replace(self.lin, state=replace(state, active=active)), (one,))

    @property
    def score(self) -> float:
        """Log-evidence less the price of its effects."""
        return self.log_evidence - price(self.chosen)


@dataclass(frozen=True)
class Screened:
    """Single effects, those that promise most refined.

    Attributes:
        baseline: the model without any effect.
        singles: sets of one effect, the best first.
        log: what was best at each step, for developers.
    """

    baseline: Found
    singles: tuple[Found, ...]
    log: tuple[str, ...]


def price(chosen: Set) -> float:
    """What a set costs before any data."""
    return PRICE * len(chosen)


def label(chosen: Set) -> str:
    """For tables."""
    return " + ".join(h.label for h in chosen) or "none"


def screen(problem: Problem, start: State, progress: Progress) -> Screened:
    """Rank all single effects about the baseline, and bring the best to their own optimum."""
    first = Found(linearise(problem, start), ())
    base, lin = first.log_evidence, first.lin
    ranked = ranked_singles(lin.evidence, lin.library.hypotheses)
    most = ranked[0][0] - base
    log = ["singles: " + ", ".join(f"{h.label} {e - base:.0f}" for e, h in ranked[:6])]
    tried: list[Found] = []
    for number, (e, h) in enumerate(_by_family(ranked)[:FAMILIES]):
        part = RUNNER_UP if any(_explains(one) for one in tried) else LONG_SHOT
        if e - base < PRICE or (number and e < base + part * most):
            break
        progress(f"refining {h.label}", 0.2 + 0.08 * number)
        found = refined(problem, lin, (h,))
        log.append(f"refined {h.label}: {found.log_evidence - base:.0f}" if found else f"{h.label}: diverged")
        tried += [found] if found else []
    return Screened(first, tuple(sorted(tried, key=lambda one: -one.score)), tuple(log))


def _explains(found: Found) -> bool:
    """Whether missing torque is negligible, more probably than not."""
    levels = found.lin.problem.levels[list(found.lin.levels)]
    return bool(np.sum(posterior_of_levels(found.lin.evidence, found.chosen)[levels <= NEGLIGIBLE]) > 0.5)


def posterior_of_levels(evidence: Evidence, chosen: Set) -> Array:
    """Posterior of the levels of missing torque, (levels,)."""
    by_level = evidence.by_level(chosen)
    p = np.exp(by_level - by_level.max())
    return np.asarray(p / p.sum())


def ranked_singles(evidence: Evidence, hypotheses: Sequence[Hypothesis]) -> list[tuple[float, Hypothesis]]:
    """All single hypotheses, the best first."""
    sets: list[Set] = [(h,) for h in hypotheses]
    return [(e, chosen[0]) for e, chosen in evidence.ranked(sets, 0.0, 12)]


def _by_family(ranked: Sequence[tuple[float, Hypothesis]]) -> list[tuple[float, Hypothesis]]:
    """The best hypothesis of each effect."""
    seen: set[str] = set()
    out = []
    for e, h in ranked:
        if h.effect not in seen:
            seen.add(h.effect)
            out.append((e, h))
    return out


def refined(problem: Problem, lin: Linearised, chosen: Set) -> Found | None:
    """Gauss-Newton steps to a set's own optimum; None where they diverge."""
    effects = {h.effect for h in chosen}
    before = lin.evidence.total(chosen, with_constraints=True)
    for iteration in range(ITERATIONS):
        level = lin.evidence.best_level(chosen)
        try:
            state = moved(lin, chosen, level, lin.levels[level])
            state = replace(state, ratio=RATIO[min(iteration, len(RATIO) - 1)])
            lin = linearise(problem, state, near(problem, lin.levels[level]), effects)
        except np.linalg.LinAlgError:
            return None
        chosen = matching(lin, chosen)
        after = lin.evidence.total(chosen, with_constraints=True)
        fastest = max(float(np.max(np.abs(way.w))) for way in state.ways)
        if not np.isfinite(after) or not fastest < 200:
            return None
        settled = iteration + 1 >= len(RATIO) or not state.active
        if settled and abs(after - before) < PRICE / 3:
            break
        before = after
    return Found(lin, chosen)


def matching(lin: Linearised, chosen: Set) -> Set:
    """The hypotheses of a new linearisation that are these; of those with states, the one at the state's values."""
    out = []
    for old in chosen:
        same = [h for h in lin.library.hypotheses if _is_same(h, old)]
        out.append(max(same, key=lambda h: (h.start is not None, lin.evidence.total((h,)))))
    return tuple(out)


def _is_same(new: Hypothesis, old: Hypothesis) -> bool:
    """Whether two hypotheses are of the same effect, place and unknowns; values of one with a shape vary."""
    if new.key != old.key or bool(new.local) != bool(old.local):
        return False
    named = [[c.parameter for c in h.coefficients] for h in (new, old)]
    weights = [np.concatenate([np.zeros(0), *h.weights]).tolist() for h in (new, old)]
    return old.start is not None or (named[0] == named[1] and weights[0] == weights[1])


def with_library(problem: Problem, found: Found) -> Found:
    """The set about the same state, with all hypotheses."""
    level = found.lin.levels[found.lin.evidence.best_level(found.chosen)]
    lin = linearise(problem, found.lin.state, near(problem, level))
    return Found(lin, matching(lin, found.chosen))


def with_second(problem: Problem, found: Found, screened: Screened) -> list[Found]:
    """Sets with a second effect, or another in the place of one, each more probable than the one before."""
    best, failed, looked, out = found, set[str](), None, list[Found]()
    base = screened.baseline.log_evidence
    for _ in range(_EXCHANGES):
        if looked is not best:  # all that may join the set, about its own optimum
            about, looked = with_library(problem, best), best
            lin, standing = about.lin, about.chosen
        alone = lin.evidence.total(standing, with_constraints=True) - price(standing)
        ranked = ranked_singles(lin.evidence, lin.library.hypotheses)
        sets: list[Set] = [(h,) for _, h in ranked[:4]]
        sets += [(one, h) for one in standing for h in lin.library.hypotheses]
        possible = [s for s in sets if len(s) <= MOST and compatible(s) and label(s) not in failed]
        candidates = lin.evidence.ranked(possible, PRICE, 1)
        # what adds less than columns err by would not be named anyway
        if not candidates or candidates[0][0] < alone + max(PRICE / 3, ALIKE * (alone - base)):
            break
        chosen = candidates[0][1]
        if {h.key for h in chosen} == {h.key for h in best.chosen}:
            break
        grown = refined(problem, lin, chosen)
        if grown is None or grown.score < best.score + PRICE / 3:
            failed.add(label(chosen))
            continue
        best = grown
        out.append(grown)
    return out


def alternatives(problem: Problem, found: Found) -> list[Found]:
    """Sets with another effect or place in the stead of one, that explain nearly as much."""
    about = with_library(problem, found)
    lin, standing, out = about.lin, about.chosen, list[Found | None]()
    whole = lin.evidence.total(standing, with_constraints=True)
    for left in standing:
        kept = tuple(h for h in standing if h is not left)
        alone = lin.evidence.total(kept, with_constraints=True)
        sets: list[Set] = [(*kept, h) for h in lin.library.hypotheses if h.key != left.key]
        ranked = lin.evidence.ranked([s for s in sets if compatible(s)], 0.0, _ALTERNATIVES)
        promising = [(e, s[-1]) for e, s in ranked if e - alone > max(PRICE, RUNNER_UP * (whole - alone))]
        out += [refined(problem, lin, (*kept, h)) for _, h in _by_family(promising)[:_ALTERNATIVES]]
    return [one for one in out if one is not None]


def with_unseen(problem: Problem, found: Found) -> list[Found]:
    """The set with each effect that screening is blind to, at its likeliest usual values."""
    level = found.lin.levels[found.lin.evidence.best_level(found.chosen)]
    out, taken = list[Found](), {h.effect for h in found.chosen}
    for effect in problem.structure.offered:
        if not effect.within_friction or effect.name in taken:
            continue
        lin = linearise(problem, found.lin.state, near(problem, level), {*taken, effect.name})
        standing = matching(lin, found.chosen)
        new = max(
            (h for h in lin.library.hypotheses if h.effect == effect.name and h.start is not None),
            key=lambda h: lin.evidence.total((*standing, h)),
        )
        state = replace(found.lin.state, active={**found.lin.state.active, effect.name: new.start or {}})
        lin = linearise(problem, state, near(problem, level), {*taken, effect.name})
        out.append(Found(lin, matching(lin, (*standing, new))))
    return out


def compatible(chosen: Set) -> bool:
    """Not one effect twice at one place."""
    for i, one in enumerate(chosen):
        for other in chosen[:i]:
            if one is other:
                return False
            if one.effect == other.effect and (
                one.joints is None or other.joints is None or set(one.joints) & set(other.joints)
            ):
                return False
            if set(one.local) & set(other.local):
                return False
    return True
