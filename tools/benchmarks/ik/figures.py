"""The record of `make bench-ik`: the solver's worst rows with goals, and FABRIKc on the same targets."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from tools.benchmarks.ik.scores import SCORE_HEAD, Helix, Score
from tools.benchmarks.record import Figure, Record, Table

FABRIKC = "FABRIKc, 100 iterations"
_AT = 1e-6  # tolerance of the goals [m] and [rad]


@dataclass(frozen=True)
class Row:
    """The solver on one kind of targets: largest bend in degrees, start, and tolerance [m] and [rad]."""

    n_sections: int
    bend: int
    start: str
    tolerance: float
    score: Score

    @property
    def cells(self) -> tuple[str, ...]:
        return str(self.n_sections), f"{self.bend}°", self.start, f"{self.tolerance:g}", *self.score.cells


@dataclass(frozen=True)
class RivalRow:
    """A rival on the first of the same targets, from the straight arm."""

    n_sections: int
    bend: int
    solver: str
    score: Score

    @property
    def cells(self) -> tuple[str, ...]:
        return str(self.n_sections), f"{self.bend}°", self.solver, str(self.score.n), *self.score.cells


def record_of(rows: Sequence[Row], rivals: Sequence[RivalRow], helix: Helix, options: Mapping[str, int]) -> Record:
    """Figures of the worst rows, and all rows."""
    at, published = [row for row in rows if row.tolerance == _AT], [row for row in rivals if row.solver == FABRIKC]

    def worst(pick: Callable[[Score], float], of: Callable[..., float], **which: int) -> tuple[float, float]:
        """Return the worst values of the solver's rows and of FABRIKc's."""
        ours, theirs = (
            [pick(row.score) for row in some if all(getattr(row, key) == value for key, value in which.items())]
            for some in (at, published)
        )
        return of(ours), of(theirs)

    figures = []
    for bend, goal in ((90, 100.0), (180, 99.99)):
        solved, theirs = worst(lambda score: 100 * score.solved, min, bend=bend)
        what = f"reachable targets, bends up to {bend}°: solved, worst of 1 to 7 sections"
        figures.append(Figure(what, solved, "%", at_least=goal, rival=FABRIKC, rival_value=theirs))
    for name, most, pick in (("median", 40, lambda s: s.median), ("99 %", 400, lambda s: s.p99)):
        time, theirs = worst(pick, max, n_sections=3)
        what = f"reachable targets of three sections: time of a call, {name}"
        figures.append(Figure(what, time, "us", at_most=most, rival=FABRIKC, rival_value=theirs))
    what = "helix: time of a call from the answer before, median (1e-9)"
    figures.append(Figure(what, helix.single.median, "us", at_most=10))
    figures.append(Figure("helix as one call: time of a pose (1e-9)", helix.path.median, "us"))
    tables = {
        "solver": Table.of(("sections", "bends up to", "start", "tolerance", *SCORE_HEAD), (row.cells for row in rows)),
        "rivals": Table.of(
            ("sections", "bends up to", "solver", "targets", *SCORE_HEAD), (row.cells for row in rivals)
        ),
    }
    ways = " ".join(f"--{name} {value}" for name, value in options.items())
    followed = "all poses solved" if helix.single.solved == helix.path.solved == 1 else "not all poses solved"
    along = (
        f"Helix: {followed}, largest distance of the tip {helix.farthest:.1e} m, 99 % of the calls within"
        f" {helix.single.p99:.1f} us, {helix.single.iterations:.0f} iterations (median)."
    )
    return Record("ik", "make bench-ik", tuple(figures), tables, (f"Options: `{ways}`.", along))
