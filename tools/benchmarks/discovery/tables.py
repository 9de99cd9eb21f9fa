"""The record of a campaign: figures with goals, and tables, computed from the given results."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import product

from blind.mujoco_plant import LIBRARY, OUTSIDE, SIZES

from tools.benchmarks.discovery.answer import Answer, label
from tools.benchmarks.discovery.figures import FOUND, WRONG, bins, closed_shares, estimates, of_kind, quantile, rate
from tools.benchmarks.discovery.goals import goals
from tools.benchmarks.discovery.plans import HALVES, KINDS, NOISES, PLANTS, REGIMES
from tools.benchmarks.discovery.result import Result
from tools.benchmarks.record import Record, Table


def record_of(everything: Sequence[Result], earlier: int = 0) -> Record:
    """Return the record of the held-out half if it has results, otherwise of the other half.

    Args:
        everything: results of the present sources, at least one.
        earlier: number of earlier versions of the sources with results of the held-out half.
    """
    development, held_out = ([result for result in everything if result.plan.half == half] for half in HALVES)
    results = held_out or development
    tables = {
        "wrong causes and failures": _wrong(results),
        "effects": _by_effect(results),
        "kinds and levels": _by_level(results),
        "stated probabilities": _probabilities(results),
        "times": _times(results),
    }
    notes = _notes(results, development if held_out else [], earlier)
    return Record("discovery", "make bench-discovery", goals(results), tables, notes)


def _notes(results: Sequence[Result], others: Sequence[Result], earlier: int) -> tuple[str, ...]:
    """Return notes on the number of cases, their half and sources, and on figures of the other half, if any."""
    kinds, half = Counter(result.plan.kind for result in results), results[0].plan.half
    count = (
        f"{len(results)} cases of the {half} half: {kinds['one']} with one hidden effect of the library,"
        f" {kinds['clean']} with none, {kinds['outside']} with one outside of it, {kinds['pairs']} with two."
    )
    notes = [count, f"Sources {results[0].digest}."]
    if half == HALVES[0]:
        notes.append("The diagnosis was developed on these cases; its sources have not answered the held-out half yet.")
    if earlier:
        notes.append(
            f"{earlier} earlier version{'s' * (earlier > 1)} of the sources answered some of the held-out half."
        )
    if shares := closed_shares(results):
        low, high = (100 * quantile(shares, part) for part in (0.25, 0.75))
        notes.append(f"Quartiles of the closed share where a cause is named: {low:.1f} and {high:.1f} %.")
    if others:
        found, wrong = rate(of_kind(others, "one"), *FOUND), rate(others, Answer.WRONG_CAUSE)
        notes.append(
            f"Development half: one effect named or in a true set {found}, n {found.n};"
            f" wrong causes {wrong}, n {wrong.n}."
        )
    return tuple(notes)


def _wrong(results: Sequence[Result]) -> Table:
    bad = [r for kind in (*WRONG, Answer.FAILED) for r in results if r.answer is kind]
    rows = []
    for result in bad:
        hidden = (
            f"{e['name']}{'' if e['joint'] is None else '@' + str(e['joint'])} {e['amount']:.2g} {e['unit']}"
            for e in result.hidden
        )
        named = "; ".join(f"{label(one['effects'])} ({one['relative_fit']:.2f})" for one in result.sets[:4])
        failure = "".join(result.failure.strip().splitlines()[-1:]).replace("|", "/")
        closed = "" if result.verdict is None else f"{100 * (result.verdict['closed']['value'] or 0.0):.0f} %"
        rows.append((result.answer.value, " + ".join(hidden) or "nothing", named or failure, closed, result.plan))
    return Table.of(("", "hidden", "named (relative fit)", "closed", "case"), rows)


def _by_effect(results: Sequence[Result]) -> Table:
    """Return by size and plant right + in a true set / cases, a ! for each wrong cause or set, and what was named.

    Estimates: number of 95 % intervals that contain the truth / number of values, and their median error.
    """
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
    return Table.of((*head, "estimates"), (row for *_, row in rows))


def _of_estimates(results: Sequence[Result]) -> str:
    found = estimates(results)
    error = quantile((abs(one.value / one.truth - 1) for one in found), 0.5)
    return f"{sum(one.is_covered for one in found)}/{len(found)}, {100 * error:.1f} %" if found else ""


def _said(result: Result) -> str:
    """Return the named effects without joints, or the verdict."""
    sets = {" + ".join(sorted(cause["effect"] for cause in one["effects"])) or "nothing" for one in result.sets}
    if sets:
        return f"{{{', '.join(sorted(sets))}}}"
    return "failed" if result.verdict is None else str(result.verdict["verdict"])


def _by_level(results: Sequence[Result]) -> Table:
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
    return Table.of(("cases", "n", *(a.value for a in Answer), "right or in a true set"), rows)


def _probabilities(results: Sequence[Result]) -> Table:
    rows = ((f"{mean:.2f}", true.n, true) for mean, true in bins(results))
    return Table.of(("of a set, mean", "n", "is the true one"), rows)


def _times(results: Sequence[Result]) -> Table:
    """Return processor time of one diagnosis and peak memory of its process so far, including the plants."""
    rows = []
    for runs, regime in product((8, 4), REGIMES):
        mine = [r for r in results if (r.plan.runs, r.plan.regime) == (runs, regime)]
        seconds = [f"{quantile((r.seconds for r in mine), part):.1f}" for part in (0.5, 0.9, 1.0)]
        if mine:
            rows.append((f"{runs} {regime}", len(mine), *seconds, f"{quantile((r.memory for r in mine), 1.0):.0f}"))
    head = ("recordings", "n", "median [s]", "90 % within [s]", "longest [s]", "memory [MiB]")
    return Table.of(head, rows)
