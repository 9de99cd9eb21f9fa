"""All measurements of the integrators, and their record."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from tools.benchmarks.dynamics import space
from tools.benchmarks.dynamics.growth import Size, exponent
from tools.benchmarks.dynamics.orders import STEPS, Convergence
from tools.benchmarks.dynamics.rivals import BASELINE, OURS, SUNDAE
from tools.benchmarks.dynamics.space import InSpace
from tools.benchmarks.record import Figure, Record, Table


@dataclass(frozen=True)
class Score:
    """One way to integrate the release: processor time [s], largest error [deg], time with ten sensitivities [s]."""

    name: str
    seconds: float
    error: float
    with_derivatives: float | None


@dataclass(frozen=True)
class Result:
    """All measurements; the last score is that of the library's default."""

    scores: Sequence[Score]
    sizes: list[Size]
    convergence: Sequence[Convergence]
    slope_errors: Mapping[float, float]
    in_space: Sequence[InSpace] = ()

    @property
    def best(self) -> Score:
        """The library's default."""
        return self.scores[-1]

    @property
    def baseline(self) -> Score:
        """SciPy's BDF in its usual form."""
        return next(score for score in self.scores if score.name == BASELINE)

    @property
    def rival(self) -> Score:
        """The fastest method outside of this library."""
        return min((one for one in self.scores if not one.name.startswith(OURS)), key=lambda one: one.seconds)

    def speed_up(self, score: Score) -> float:
        """Return the speed-up over the baseline."""
        return self.baseline.seconds / score.seconds


def record_of(result: Result) -> Record:
    """Return the figures with goals for speed and accuracy, and all tables."""
    best, rival = result.best, result.rival
    figures = [
        Figure(
            f"release of 1.6 s: times as fast as {BASELINE}", result.speed_up(best), at_least=50,
            rival=rival.name, rival_value=result.speed_up(rival),
        ),
        Figure(
            "release of 1.6 s: largest error of an angle", best.error, "degrees", at_most=0.05,
            rival=rival.name, rival_value=rival.error,
        ),
        *_with_sensitivities(result),
        *([Figure("time of a simulated second over joints: exponent", exponent(result.sizes))] if result.sizes else []),
        *(space.figures(result.in_space) if result.in_space else []),
    ]  # fmt: skip
    tables = {
        "integrators": Table.of(
            ("integrator", "time [ms]", "times as fast", "error [deg]", "with sensitivities [ms]"),
            [_score_row(result, score) for score in result.scores],
        ),
        "orders": Table.of(
            ("method", *(f"{steps} steps" for steps in STEPS), "measured orders"), map(_order_row, result.convergence)
        ),
        "sensitivities": Table.of(
            ("relative tolerance", *(f"{relative:.0e}" for relative in result.slope_errors)),
            [("error", *(f"{100 * error:.2g} %" for error in result.slope_errors.values()))],
        ),
        "space": space.table(result.in_space),
        "joints": Table.of(
            ("joints", "compiling, once [s]", "processor time of a simulated second [s]", "steps a second"),
            ((s.n_joints, f"{s.compiling:.1f}", f"{s.per_second:.3g}", f"{s.steps:.0f}") for s in result.sizes),
        ),
    }
    there = any(score.name == SUNDAE for score in result.scores)
    notes = () if there else ("CVODE by scikit-sundae was not installed.",)
    return Record("dynamics", "make bench-dynamics", tuple(figures), tables, notes)


def _with_sensitivities(result: Result) -> list[Figure]:
    """Return figures of the library's default and of the fastest rival with sensitivities."""
    known = [(one.with_derivatives, one.name) for one in result.scores if one.with_derivatives is not None]
    rivals = [one for one in known if not one[1].startswith(OURS)]
    if result.best.with_derivatives is None or not rivals:
        return []
    seconds, name = min(rivals)
    what = "release of 1.6 s with sensitivities to ten parameters"
    return [Figure(what, 1e3 * result.best.with_derivatives, "ms", rival=name, rival_value=1e3 * seconds)]


def _score_row(result: Result, score: Score) -> tuple[str, ...]:
    sensitivities = "" if score.with_derivatives is None else f"{1e3 * score.with_derivatives:.1f}"
    times = f"{1e3 * score.seconds:.1f}", f"{result.speed_up(score):.1f}"
    return score.name, *times, f"{score.error:.4f}", sensitivities


def _order_row(method: Convergence) -> tuple[str, ...]:
    orders = ", ".join(f"{order:.2f}" for order in method.orders)
    return method.name, *(f"{error:.1e}" for error in method.errors), orders
