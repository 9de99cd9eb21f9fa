"""The result of a fit by open-loop simulations: values with uncertainties, errors, simulations of whole recordings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import mean_error
from continuum.discovery.normal_equations import Values
from continuum.discovery.problem import State
from continuum.discovery.unknowns import Unknown, Unknowns
from continuum.dynamics.effect_lookup import effect_named


@dataclass(frozen=True)
class OpenLoop:
    """Simulations of all recordings from start to end.

    Attributes:
        angles: as the sensors would read them, by recording, (n_times, n) each [rad]; NaN where a simulation failed.
        floor: error from the sensors' noise alone [rad].
        of_segments: error of short segments, each simulated from its initial state [rad].
    """

    angles: tuple[Array, ...]
    floor: float
    of_segments: float

    def error(self, run: int, theta: Array) -> float:
        """Return the root mean square distance from measured angles (n_times, n) [rad], over rows and joints."""
        return float(np.sqrt(np.nanmean((self.angles[run] - theta) ** 2)))


@dataclass(frozen=True)
class Fitted:
    """The fit of a set.

    Attributes:
        state: state with the fitted values.
        unknowns, values: what was fitted, and the result.
        sd: standard deviations of the common unknowns, larger where segments disagree, (k,).
        correlation: correlation of the common unknowns, (k, k).
        per_run_sd: standard deviations of the per-run unknowns, by recording.
        errors: root mean square over rows and joints of each segment, with common values estimated from the other
            segments, (segments,) [rad]; NaN where a simulation failed.
        observations: number of independent residuals.
        agreement: p-value of the segments' disagreement, as `Candidate.agreement`.
        settled: whether further steps would change little.
    """

    state: State
    unknowns: Unknowns
    values: Values
    sd: Array
    correlation: Array
    per_run_sd: tuple[Array, ...]
    errors: Array
    observations: float
    agreement: float
    settled: bool

    @property
    def error(self) -> float:
        """Geometric mean of the errors [rad]; infinite where a simulation failed."""
        return float(mean_error(self.errors))

    @property
    def occam(self) -> float:
        """Minus the log Occam factor of all per-run values (MacKay, Neural Computation 4, 1992, 415).

        Left-out segments test common values as a new recording would, but not per-run values, which the recording's
        other segments determine.
        """
        pairs = [(one.sd, sd) for those, sds in zip(self.unknowns.per_run, self.per_run_sd, strict=True)
                 for one, sd in zip(those, sds, strict=True)]  # fmt: skip
        return float(sum(max(0.0, np.log(prior / sd)) for prior, sd in pairs)) if self.completed else 0.0

    @property
    def departure(self) -> float:
        """Minus the log prior density of the common values, up to a constant: how unusual they are."""
        pairs = zip(self.unknowns.common, self.values.common, strict=True)
        return 0.5 * float(sum(((value - one.mean) / one.sd) ** 2 for one, value in pairs))

    @property
    def completed(self) -> bool:
        """Whether it can be simulated."""
        return bool(np.all(np.isfinite(self.errors)))

    @property
    def key(self) -> frozenset[object]:
        """Effects of the set with their places."""
        return frozenset(one.hypothesis.key for one in self.unknowns.all if one.hypothesis)

    @property
    def of_effects(self) -> frozenset[object]:
        """What the set's effects change; per-run values include the one that all recordings may share."""
        per_run = [one for one in self.unknowns.all if one.hypothesis]
        shared = {place for one in per_run if one.of_run is not None for place in _shared(one)}
        return frozenset(one.place for one in per_run) | shared

    @property
    def start(self) -> dict[tuple[object, ...], float]:
        """Starting values for a fit of another set, by `Unknown.key`."""
        values = np.concatenate([self.values.common, *self.values.per_run])
        return {one.key: float(value) for one, value in zip(self.unknowns.all, values, strict=True)}


def _shared(one: Unknown) -> list[tuple[object, ...]]:
    """Return the places of a per-run value if it is the same in all runs: of its effect, and of an equivalent one."""
    ((effect, _, joint), factor), *_ = one.places.items()
    found, name = [(*one.place[:-1], None)], effect_named(effect).alike_in_all_runs
    if name:
        parameter = next(iter(effect_named(name).parameters))
        found.append((((name, parameter, joint), factor), one.is_log, None))
    return found
