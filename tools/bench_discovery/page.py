"""The page of results, the worst first; every figure is computed from the results it is given."""

from __future__ import annotations

import platform
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import version
from statistics import median

from blind.plant import EFFECTS, LIBRARY, OUTSIDE, SIZES, Plan

from tools.bench_discovery.answer import Answer
from tools.bench_discovery.calibration import bins, expected_error, statements
from tools.bench_discovery.estimates import by_parameter, coverage, estimates, median_error
from tools.bench_discovery.goals import WANTED_OF_EACH, counts, goals
from tools.bench_discovery.plans import campaign_of
from tools.bench_discovery.reasons import REASONS
from tools.bench_discovery.result import Result
from tools.bench_discovery.score import (
    Tally,
    ambiguous_sets,
    by_size,
    confusion,
    gaps_closed,
    judged,
    losses,
    name_of,
    of_kind,
    quantile,
    smallest_found,
    tallies,
)
from tools.markdown import paragraph, table

MENDED_ON = 2023
"""Campaign whose wrong answers were looked into."""

RULES = paragraph(
    "Rates have Wilson intervals of 95 %. *Too few*: fewer than 20 cases (of one effect and of the time 5; of a rate",
    "that shall be small three times its inverse) that do not show by themselves",
    'that the goal is missed. "Right" is the verdict `cause` with the hidden effect alone, at its joint; an ambiguous',
    "verdict that names it beside others is counted apart, never as right. Held-out runs are",
    "runs of the same dataset; motions of another kind than those of the dataset are not predicted.",
)


def page(results: Sequence[Result], replaced: Sequence[Result] = ()) -> str:
    """The whole page, of at least one result, and of those that later versions replaced."""
    one, clean, outside, pairs = (of_kind(results, kind) for kind in ("one", "clean", "outside", "pairs"))
    aims = ((goal.what, goal.wanted, goal.figure, goal.status) for goal in goals(results))
    sections = {
        "Goals, on cases that no version was mended on": _unseen(results, replaced) + "\n\n" + RULES,
        "Goals, on all cases, as answered last": table(("", "goal", "reached", ""), aims),
        "One hidden effect, the worst first": _tally_table("effect", tallies(one, name_of)),
        "Why some are seldom named": _reasons([*one, *outside]),
        "By size": _sizes(one),
        "One hidden effect, by dataset": _tally_table("dataset", tallies(one, _dataset)),
        "One hidden effect, by noise": _tally_table("noise", tallies(one, _noise)),
        "Nothing hidden": _tally_table("dataset", tallies(clean, _dataset)) + _lost(clean),
        "Outside of the library": _tally_table("effect, size", tallies(outside, _name_and_size)),
        "Two effects": _tally_table("effects", tallies(pairs, name_of)),
        "What was answered to what": _confusion(results) + "\n\n" + _sets(results),
        "Wrong causes, case by case": _wrong(results),
        "Answers of earlier versions to the same cases": _replaced(replaced),
        "Confidence": _calibration(results),
        "Parameters": _parameters(one),
        "Gain": _gain(one),
        "Time": _time(results),
    }
    return "\n\n".join([_head(results), *(f"## {title}\n\n{body}" for title, body in sections.items())]) + "\n"


def _unseen(results: Sequence[Result], replaced: Sequence[Result]) -> str:
    """The same goals on the cases that show how well it does on what it was not mended on: as first answered."""
    said = paragraph(
        f"What was answered wrongly to cases of campaign {MENDED_ON} was looked into, and the analysis mended, while",
        "the campaign went on: its rates are those of data that it was developed on. Cases of other campaigns count",
        "here as they were answered first, whatever a later version says of them.",
    )
    first: dict[Plan, Result] = {}
    for result in (*replaced, *results):
        first.setdefault(result.plan, result)
    unseen = [result for plan, result in first.items() if campaign_of(plan) != MENDED_ON]
    if not unseen:
        return said + "\n\nThere are none yet."
    aims = ((goal.what, goal.wanted, goal.figure, goal.status) for goal in goals(unseen))
    return f"{said}\n\n{table(('', 'goal', 'reached', ''), aims)}\n\nWrong causes among them:\n\n{_wrong(unseen)}"


def _replaced(replaced: Sequence[Result]) -> str:
    counted = Counter(judged(result).value for result in replaced)
    told = ", ".join(f"{name} {count}" for name, count in counted.most_common()) or "none"
    said = paragraph(f"Replaced above by what the latest version answered: {told}. The wrong ones:")
    return f"{said}\n\n{_wrong(replaced)}"


def _head(results: Sequence[Result]) -> str:
    hours = sum(result.seconds for result in results) / 3600
    versions = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "casadi", "mujoco"))
    digests = ", ".join(sorted({result.digest for result in results}))
    kinds = Counter(result.kind for result in results)
    paragraphs = (
        paragraph(
            "Made by `make bench-discovery`, which writes every figure here and every verdict in",
            f"`data/discovery_benchmark.jsonl`, from {len(results)} cases:",
            f"{kinds['one']}",
            f"with one hidden effect of the library, {kinds['clean']} with none, {kinds['outside']} with one outside",
            "of",
            f"the library, {kinds['pairs']} with two.",
        ),
        paragraph(
            "Each case is an arm of its own, simulated by `test/blind/plant` (MuJoCo, no code in common with the",
            "library):",
            "parameters vary from arm to arm, and the size (within a tenth of its nominal value), sign and joint of an",
            "effect, the motions, the order of the files and the noise are drawn by a seed that belongs to the",
            "campaign",
            "alone. Datasets and levels of noise take turns, where a dataset can show the effect:",
            f"{_shares(results, _dataset)}; noise {_shares(results, _noise)}; sizes where one effect is hidden",
            f"{_shares(of_kind(results, 'one'), _size)}. {_cells(of_kind(results, 'one'))}",
            "The analysis is `continuum diagnose`",
            "as a",
            "process of its own on one core that is handed the files, and nothing else.",
        ),
        paragraph(
            "Not of another formula than the library's are the plant's `actuator_lag`, since a first-order lag has but",
            "one, which the plant solves step by step, and its `tension_scale`, a factor.",
            "`kinked_spring` is hidden in driven motions alone: after a release",
            "it is a softer spring, and named so. `held_cable` is in the library and never hidden.",
            *_without_a_case(results),
        ),
        paragraph(
            f"The diagnoses took {hours:.1f} hours of processor time on",
            f"{platform.processor() or platform.machine()}, Python",
            f"{platform.python_version()}, {versions}; sources {digests}.",
        ),
    )
    return "\n\n".join(["# Discovery benchmark", *paragraphs])


def _without_a_case(results: Sequence[Result]) -> list[str]:
    """A sentence on what may be hidden and is not yet."""
    names = [f"`{n}`" for n in (*LIBRARY, *OUTSIDE) if all(n not in result.plan.effects for result in results)]
    return [f"In no case yet: {', '.join(names)}."] if names else []


def _shares(results: Sequence[Result], by: Callable[[Result], str]) -> str:
    return ", ".join(f"{name} ({count})" for name, count in Counter(map(by, results)).most_common())


def _dataset(result: Result) -> str:
    return result.plan.dataset


def _size(result: Result) -> str:
    return result.plan.size


def _cells(one: Sequence[Result]) -> str:
    """In how few datasets and noises effects were hidden: a table by one of them shows the other's doing, too."""
    cells = {(name_of(result), result.plan.dataset, result.plan.noise) for result in one}
    effects = {name for name, _, _ in cells}
    return (
        f"These {len(one)} cases are {len(cells)} combinations of an effect, a dataset and a noise, {len(effects)}"
        " effects in all: until campaign 2026 every campaign began an effect in the same one, so that rates by dataset"
        " and by noise below are those of effects as well."
    )


def _noise(result: Result) -> str:
    return result.plan.noise


def _name_and_size(result: Result) -> str:
    return f"{name_of(result)}, {result.plan.size}"


def _tally_table(what: str, groups: Mapping[str, Tally]) -> str:
    head = (what, "n", *(one.value for one in Answer), "rate of right", "right or in a set")
    rows = (
        (name, group.n, *(n or "" for n in counts(group)), group.right, group.right_or_set)
        for name, group in groups.items()
    )
    return table(head, rows)


def _reasons(results: Sequence[Result]) -> str:
    """What is known of effects that are named less often than wanted."""
    seldom = [name for name, group in tallies(results, name_of).items() if group.right.value < WANTED_OF_EACH]
    lines = [paragraph(f"- `{name}`: {REASONS.get(name, 'not looked into yet.')}") for name in seldom]
    return "\n".join(lines) or "None is."


def _sizes(one: Sequence[Result]) -> str:
    rows = []
    for effect in LIBRARY:
        sizes = by_size(one, effect)
        if any(group.n for group in sizes.values()):
            kind = EFFECTS[effect]
            cells = (f"{sizes[size].right.k} + {sizes[size].rate(Answer.SET).k} of {sizes[size].n}" for size in SIZES)
            amounts = ", ".join(f"{amount:g}" for amount in kind.sizes)
            rows.append((effect, f"{amounts} {kind.unit}", *cells, smallest_found(sizes, effect)))
    said = paragraph(
        "Right + in an ambiguous set, of all cases. The size that is named rightly with 90 % probability is read off",
        "between sizes where each has at least five cases.",
    )
    return said + "\n\n" + table(("effect", "small, medium, large", *SIZES, "found with 90 %"), rows)


def _lost(clean: Sequence[Result]) -> str:
    lost = losses(clean)
    return f"\n\nEq. 19 of the position on held-out runs grows by at most {100 * max(lost):.1f} %." if lost else ""


def _confusion(results: Sequence[Result]) -> str:
    matrix = confusion(results)
    answered = {column for row in matrix.values() for column in row}
    columns = [name for name in EFFECTS if name in answered]
    columns += [name for name in ("several", "ambiguous", "unknown", "adequate", "no verdict") if name in answered]
    numbers = {name: str(i) if name in EFFECTS else name for i, name in enumerate(columns, 1)}
    rows = (
        (f"{numbers[name]} {name}" if name in numbers else name, *(row[column] or "" for column in columns))
        for name, row in matrix.items()
    )
    return (
        "Rows: what is hidden. Columns: the cause that is named alone, by its row's number, or the verdict.\n\n"
        + table(("hidden", *(numbers[column] for column in columns)), rows)
    )


def _sets(results: Sequence[Result]) -> str:
    rows = [
        (name, f"{{{members}}}", count)
        for name, sets in ambiguous_sets(results).items()
        for members, count in sets.items()
    ]
    return "Ambiguous sets where one effect is hidden:\n\n" + table(("hidden", "named", "times"), rows)


def _wrong(results: Sequence[Result]) -> str:
    rows = []
    for result in results:
        if judged(result) in (Answer.WRONG_CAUSE, Answer.WRONG_JOINT) and result.verdict is not None:
            hidden = " and ".join(
                _told(e["name"], e["joint"], f" {e['amount']:.3g} {e['unit']}") for e in result.hidden
            )
            causes = " and ".join(
                _told(c["effect"], c["joint"], f" {c['confidence']:.2f}") for c in result.verdict["causes"]
            )
            rows.append((hidden or "nothing", causes, result.plan.dataset, result.plan.noise, result.plan.seed))
    return table(("hidden", "named, with its confidence", "dataset", "noise", "seed"), rows)


def _told(name: str, joint: int | None, more: str) -> str:
    return name + ("" if joint is None else f"@{joint}") + more


def _calibration(results: Sequence[Result]) -> str:
    stated = statements(results)
    if not stated:
        return "None is stated."
    alone = statements(results, ("cause",))
    of_causes = f"; of `cause` alone {expected_error(alone):.3f} (n {len(alone)})" if alone else ""
    said = paragraph(
        "Of everything that is named in the verdicts `cause` and `ambiguous`, whatever is hidden:",
        f"ECE {expected_error(stated):.3f} (n {len(stated)}){of_causes}.",
    )
    rows = ((f"{one.confidence:.2f}", one.rate) for one in bins(stated))
    return said + "\n\n" + table(("mean confidence", "is there"), rows)


def _parameters(one: Sequence[Result]) -> str:
    found = estimates(one)
    rows = (
        (name, len(group), f"{100 * median_error(group):.1f} %", coverage(group))
        for name, group in by_parameter(found).items()
    )
    said = paragraph(
        "Of effects that were named at their joints, where the plant's amount and the library's parameter are one",
        "quantity",
        "of one sign. The joints' own spread in the plant (1.5 % of stiffness, 2 % of friction) is not taken out of",
        "the",
        "truth, and `load_friction` differs in its formula: the library's leaves accelerations out of the load.",
    )
    return said + "\n\n" + table(("parameter", "n", "median error", "95 % intervals that hold the truth"), rows)


def _gain(one: Sequence[Result]) -> str:
    rows = []
    for name in sorted({name_of(result) for result in one}):
        closed = gaps_closed(result for result in one if name_of(result) == name)
        if closed:
            rows.append(
                (median(closed), (name, len(closed), f"{100 * median(closed):.0f} %", f"{100 * min(closed):.0f} %"))
            )
    return (
        "Part of the distance to the noise floor (Eq. 19 of the position) that is closed on held-out runs.\n\n"
        + table(("effect", "n", "median", "worst"), (row for _, row in sorted(rows)))
    )


def _time(results: Sequence[Result]) -> str:
    rows = []
    for name in sorted({_dataset(result) for result in results}):
        seconds = [result.seconds for result in results if _dataset(result) == name]
        rows.append((name, len(seconds), *(f"{quantile(seconds, part):.0f}" for part in (0.5, 0.9, 1.0))))
    said = paragraph(
        "Processor time of one diagnosis, held-out runs and intervals included, and compiling where a combination of",
        "effects was met for the first time.",
    )
    return said + "\n\n" + table(("dataset", "n", "median [s]", "90 % within [s]", "longest [s]"), rows)
