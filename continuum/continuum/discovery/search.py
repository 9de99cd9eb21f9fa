"""Search for sets of effects: the expected gain of one more effect.

Effects whose sizes enter linearly are screened by open-loop sensitivities. Those with states, delays and shapes are
screened by the filter's evidence and brought to its optimum: an open-loop fit converges to them only from nearby.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from continuum.discovery.decision import PRICE
from continuum.discovery.evidence import Set
from continuum.discovery.gauss_newton import moved
from continuum.discovery.hypotheses import Hypothesis
from continuum.discovery.problem import Linearised, Problem, linearise, near

MOST = 2
"""Most effects that are named together: three would need more runs than a laboratory makes."""
RATIO = (1.6, 1.25, 1.1)
"""Factors by which values of nonlinear effects are changed for finite differences, in successive Gauss-Newton steps."""
FAMILIES = 3
"""Most effects of each kind, linear or not, that are fitted about a set."""
LONG_SHOT = 0.2
"""Fraction of the best effect's gain in evidence from which a nonlinear one is fitted: its linearisation is poor."""
RUNNER_UP = 0.6
"""Fraction of the best effect's expected gain from which another linear one is fitted: screening errs by a third."""
_FASTEST = 200.0  # rad/s, of a joint: a trajectory has diverged

type Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class Found:
    """A set of effects at its optimum.

    Attributes:
        lin: linearised state.
        chosen: the set.
    """

    lin: Linearised
    chosen: Set

    @property
    def label(self) -> str:
        """Label for tables."""
        return " + ".join(h.label for h in self.chosen) or "none"

    @property
    def log_evidence(self) -> float:
        """Log-evidence of the set."""
        return self.lin.evidence.total(self.chosen, with_constraints=True)

    @property
    def key(self) -> frozenset[object]:
        """Effects of the set with their places."""
        return frozenset(h.key for h in self.chosen)

    def without(self, left: Hypothesis) -> Found:
        """Return the set without one effect, about the same state."""
        state, rest = self.lin.state, tuple(h for h in self.chosen if h is not left)
        active = {effect: params for effect, params in state.active.items() if effect in {h.effect for h in rest}}
        return Found(replace(self.lin, state=replace(state, active=active)), rest)

    @property
    def effects(self) -> int:
        """Number of effects; friction that a model file lacks does not count, as it is fitted to any other arm too."""
        return sum(not h.is_refit for h in self.chosen)

    @property
    def level(self) -> int:
        """The most probable level of missing torque, among the problem's."""
        return self.lin.levels[self.lin.evidence.best_level(self.chosen)]


def with_library(problem: Problem, found: Found) -> Found:
    """Return the set about the same state, with all hypotheses."""
    lin = linearise(problem, found.lin.state, near(problem, found.level))
    return Found(lin, matching(lin, found.chosen))


def with_one_more(problem: Problem, about: Found, linear: Sequence[tuple[float, Hypothesis]]) -> list[Found]:
    """Return the most promising sets with one more effect.

    Args:
        problem: what stays fixed during the search.
        about: set with all hypotheses about its state.
        linear: gains expected from open-loop sensitivities, the best first.
    """
    out = with_linear(about, linear)
    evidence, alone = about.lin.evidence, about.log_evidence
    sets: list[Set] = [(*about.chosen, h) for h in about.lin.library.hypotheses if _may_join(about.chosen, h)]
    if not sets:
        return []
    least = max(PRICE, LONG_SHOT * (evidence.ranked(sets, 0.0, 1)[0][0] - alone))
    ranked = evidence.ranked([one for one in sets if one[-1].start is not None], 0.0, 2 * FAMILIES)
    for gain, h in _by_effect([(e - alone, one[-1]) for e, one in ranked])[:FAMILIES]:
        if gain > least and (found := refined(problem, about.lin, (*about.chosen, h))) is not None:
            out.append(found)
    return out


def with_linear(about: Found, linear: Sequence[tuple[float, Hypothesis]]) -> list[Found]:
    """Return sets with one more effect whose size enters linearly, by expected gain, the best first."""
    able = [(gain, h) for gain, h in linear if _may_join(about.chosen, h)]
    promising = [(gain, h) for gain, h in able if gain > RUNNER_UP * able[0][0]]
    return [Found(about.lin, (*about.chosen, h)) for _, h in _by_effect(promising)[:FAMILIES]]


def with_unseen(problem: Problem, about: Found) -> list[Found]:
    """Return the set with each effect that the filter cannot see, at the likeliest of its screened values."""
    out, lin = list[Found](), about.lin
    for effect in problem.structure.offered:
        new = [h for h in lin.library.hypotheses if h.effect == effect.name and h.start and _may_join(about.chosen, h)]
        if not effect.within_friction or not new:
            continue
        likeliest = max(new, key=lambda h: lin.evidence.total((*about.chosen, h)))
        state = replace(lin.state, active={**lin.state.active, effect.name: likeliest.start or {}})
        effects = {h.effect for h in (*about.chosen, likeliest)}
        there = linearise(problem, state, near(problem, about.level), effects)
        out.append(Found(there, matching(there, (*about.chosen, likeliest))))
    return out


def _by_effect(ranked: Sequence[tuple[float, Hypothesis]]) -> list[tuple[float, Hypothesis]]:
    """Return the best two places of each effect, the best first: only fits show where an effect acts."""
    seen: dict[str, int] = {}
    out = list[tuple[float, Hypothesis]]()
    for gain, h in ranked:
        if seen.get(h.effect, 0) < 2 and h.key not in {other.key for _, other in out}:
            seen[h.effect] = seen.get(h.effect, 0) + 1
            out.append((gain, h))
    return out


def refined(problem: Problem, lin: Linearised, chosen: Set) -> Found | None:
    """Take Gauss-Newton steps towards a set's optimum; return None if they diverge."""
    effects = {h.effect for h in chosen}
    for ratio in RATIO:
        level = lin.evidence.best_level(chosen)
        try:
            state = replace(moved(lin, chosen, level, lin.levels[level]), ratio=ratio)
            lin = linearise(problem, state, near(problem, lin.levels[level]), effects)
        except np.linalg.LinAlgError:
            return None
        chosen = matching(lin, chosen)
        fastest = max(float(np.max(np.abs(way.w))) for way in state.ways)
        if not np.isfinite(lin.evidence.total(chosen)) or not fastest < _FASTEST:
            return None
    return Found(lin, chosen)


def matching(lin: Linearised, chosen: Set) -> Set:
    """Return the same hypotheses in a new linearisation; of those with states, the one at the state's values."""
    out = []
    for old in chosen:
        same = [h for h in lin.library.hypotheses if _is_same(h, old)]
        out.append(max(same, key=lambda h: (h.start is not None, lin.evidence.total((h,)))))
    return tuple(out)


def _is_same(new: Hypothesis, old: Hypothesis) -> bool:
    """Whether two hypotheses have the same effect, place and unknowns; values of one with a shape may differ."""
    if new.key != old.key or bool(new.local) != bool(old.local):
        return False
    named = [[c.parameter for c in h.coefficients] for h in (new, old)]
    weights = [np.concatenate([np.zeros(0), *h.weights]).tolist() for h in (new, old)]
    return old.start is not None or (named[0] == named[1] and weights[0] == weights[1])


def _may_join(chosen: Set, new: Hypothesis) -> bool:
    """Whether a hypothesis can join a set: no effect acts twice at one place."""
    for other in chosen:
        if new.effect == other.effect and (
            new.joints is None or other.joints is None or set(new.joints) & set(other.joints)
        ):
            return False
        if set(new.local) & set(other.local):
            return False
    return True
