"""The page of results; every figure is computed from the results it is given."""

from __future__ import annotations

import platform
from collections import Counter
from collections.abc import Sequence
from importlib.metadata import version
from itertools import product

from blind.plant import LIBRARY, OUTSIDE, SIZES

from tools.bench_discovery.answer import Answer, label
from tools.bench_discovery.figures import FOUND, WRONG, bins, estimates, of_kind, quantile, rate
from tools.bench_discovery.goals import goals
from tools.bench_discovery.plans import HALVES, KINDS, NOISES, PLANTS, REGIMES
from tools.bench_discovery.result import Result
from tools.markdown import paragraph, table

_MOST_LISTED = 20
_RULES = paragraph(
    "Rates have Wilson intervals of 95 % in brackets. *Right*: the verdict `cause` with exactly the hidden effects,",
    "each at its joint. *In a set*: `ambiguous`, and one set is exactly that. *Part*: only hidden effects are named,",
    "not all. *Missed*: `adequate`. *Wrong cause*: an effect or joint is named that is not hidden, alone or beside a",
    "hidden one. *Wrong set*: `ambiguous` without the true set. Of an effect outside of the library, right is",
    "`unknown` or a verdict that says that it is not complete; of an arm without effects `adequate`. What the smallest",
    "sizes are that the data can show at all (the power of the diagnosis) is not measured yet.",
)


def page(everything: Sequence[Result], earlier: int = 0) -> str:
    """The whole page, of at least one result.

    Args:
        everything: results of the present sources.
        earlier: other versions of the sources that answered cases of the held-out half.
    """
    development, held_out = ([result for result in everything if result.plan.half == half] for half in HALVES)
    results = held_out or development
    aims = ((goal.what, goal.wanted, goal.figure, goal.n, goal.status) for goal in goals(results))
    sections = {
        "Goals": table(("goal", "wanted", "reached", "n", ""), aims) + "\n\n" + _RULES,
        "Wrong causes, wrong sets and failures": _wrong(results),
        "By effect, size and plant, and what was named instead": _by_effect(results),
        "By kind, plant, regime, noise and number of recordings": _by_level(results),
        "Stated probabilities": _probabilities(results),
        "Times": _times(results),
    }
    head = [_head(results), _halves(development, held_out, earlier)]
    return "\n\n".join([*head, *(f"## {title}\n\n{body}" for title, body in sections.items())]) + "\n"


def _head(results: Sequence[Result]) -> str:
    kinds = Counter(result.plan.kind for result in results)
    versions = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "numba", "mujoco"))
    text = paragraph(
        f"Made by `make bench-discovery` from {len(results)} cases of `data/discovery_benchmark.jsonl`: {kinds['one']}",
        f"with one hidden effect of the library, {kinds['clean']} with none, {kinds['outside']} with one outside of",
        f"it, {kinds['pairs']} with two. Each is an arm of its own, of `test/blind/plant` (MuJoCo) or",
        "`test/blind/moreau` (Moreau's time stepping, angles without rates), which share no code with the library.",
        "Parameters, sign, joint and exact amount, motions and noise are drawn by the case's seed. The diagnosis is",
        "handed the CSV files alone.",
        f"Sources {results[0].digest}, {platform.machine()}, Python {platform.python_version()}, {versions}.",
    )
    return f"# Discovery benchmark\n\n{text}"


def _halves(development: Sequence[Result], held_out: Sequence[Result], earlier: int) -> str:
    versions = f"{earlier} earlier version{'s' * (earlier > 1)} of the sources answered some of it" if earlier else ""
    if not held_out:
        return paragraph(
            "**Development half only.** These cases may be looked at, and the analysis is mended on them: the figures",
            "are those of data that it was developed on. The held-out half is not answered yet by these sources.",
            f"{versions}." if earlier else "",
        )
    found, wrong = rate(of_kind(development, "one"), *FOUND), rate(development, Answer.WRONG_CAUSE)
    return paragraph(
        "These are cases of the held-out half, on which nothing is mended.",
        f"{versions}." if earlier else "",
        f"Development half: one effect named or in a true set {found}, n {found.n}; wrong causes {wrong}, n {wrong.n}.",
    )


def _wrong(results: Sequence[Result]) -> str:
    bad = [r for kind in (*WRONG, Answer.FAILED) for r in results if r.answer is kind]
    rows = []
    for result in bad[:_MOST_LISTED]:
        hidden = (
            f"{e['name']}{'' if e['joint'] is None else '@' + str(e['joint'])} {e['amount']:.2g} {e['unit']}"
            for e in result.hidden
        )
        named = "; ".join(f"{label(one['effects'])} ({one['probability']:.2f})" for one in result.sets[:4])
        failure = "".join(result.failure.strip().splitlines()[-1:]).replace("|", "/")
        closed = "" if result.verdict is None else f"{100 * (result.verdict['closed']['value'] or 0.0):.0f} %"
        rows.append((result.answer.value, " + ".join(hidden) or "nothing", named or failure, closed, result.plan))
    more = f"\n\nAnd {len(bad) - _MOST_LISTED} more." if len(bad) > _MOST_LISTED else ""
    return table(("", "hidden", "named (probability)", "closed", "case"), rows) + more


def _by_effect(results: Sequence[Result]) -> str:
    rows = []
    for names in ((), *((name,) for name in (*OUTSIDE, *LIBRARY))):
        mine = [result for result in results if result.plan.effects == names]
        cells = [[r for r in mine if (r.plan.size, r.plan.plant) == cell] for cell in product(SIZES, PLANTS)]
        texts = (
            f"{rate(c, Answer.RIGHT).k}+{rate(c, Answer.SET).k}/{len(c)}{'!' * rate(c, *WRONG).k}" if c else ""
            for c in cells
        )
        visible = rate((r for r in mine if r.plan.size != "small"), *FOUND)
        others = Counter(_said(result) for result in mine if result.answer not in FOUND).most_common(4)
        output = ", ".join(f"{what} {n}" for what, n in others)
        row = (names[0] if names else "nothing", *texts, visible, output, _of_estimates(mine))
        rows.append((not set(names) & set(LIBRARY), visible.value if visible.n else 2.0, row))
    rows.sort(key=lambda row: row[:2])
    head = (
        "hidden",
        *(f"{size}, {plant}" for size, plant in product(SIZES, PLANTS)),
        "medium and large",
        "named instead",
    )
    said = paragraph(
        "Right + in a true set / cases, and a ! for each wrong cause or set. Estimates: 95 % intervals that hold the",
        "truth / values, and their median error, where the plants' amount is a parameter of the library; the joints'",
        "own spread in the plants (1.5 % of stiffness, 2 % of friction) is not taken out of the truth.",
    )
    return f"{said}\n\n{table((*head, 'estimates'), (row for *_, row in rows))}"


def _of_estimates(results: Sequence[Result]) -> str:
    found = estimates(results)
    error = quantile((abs(one.value / one.truth - 1) for one in found), 0.5)
    return f"{sum(one.is_covered for one in found)}/{len(found)}, {100 * error:.1f} %" if found else ""


def _said(result: Result) -> str:
    """Effects that are named, without joints, or the verdict."""
    sets = {" + ".join(sorted(cause["effect"] for cause in one["effects"])) or "nothing" for one in result.sets}
    if sets:
        return f"{{{', '.join(sorted(sets))}}}"
    return "failed" if result.verdict is None else str(result.verdict["verdict"])


def _by_level(results: Sequence[Result]) -> str:
    one = of_kind(results, "one")
    groups = {kind: of_kind(results, kind) for kind in KINDS}
    groups |= {
        f"one: {name}": [r for r in one if name in (r.plan.plant, r.plan.regime)] for name in (*PLANTS, *REGIMES)
    }
    groups |= {f"one: {name} noise": [r for r in one if r.plan.noise == name] for name in NOISES}
    groups |= {f"one: {runs} recordings": [r for r in one if r.plan.runs == runs] for runs in (8, 4)}
    rows = (
        (name, len(group), *(rate(group, a).k or "" for a in Answer), rate(group, *FOUND))
        for name, group in groups.items()
        if group
    )
    return table(("cases", "n", *(a.value for a in Answer), "right or in a true set"), rows)


def _probabilities(results: Sequence[Result]) -> str:
    rows = ((f"{mean:.2f}", true.n, true) for mean, true in bins(results))
    return table(("of a set, mean", "n", "is the true one"), rows)


def _times(results: Sequence[Result]) -> str:
    rows = []
    for runs, regime in product((8, 4), REGIMES):
        mine = [r for r in results if (r.plan.runs, r.plan.regime) == (runs, regime)]
        seconds = [f"{quantile((r.seconds for r in mine), part):.1f}" for part in (0.5, 0.9, 1.0)]
        if mine:
            rows.append((f"{runs} {regime}", len(mine), *seconds, f"{quantile((r.memory for r in mine), 1.0):.0f}"))
    said = "Processor time of one diagnosis; memory is the most that its process had until then, the plants included."
    head = ("recordings", "n", "median [s]", "90 % within [s]", "longest [s]", "memory [MiB]")
    return f"{said}\n\n{table(head, rows)}"
