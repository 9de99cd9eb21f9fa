"""One extension of the model, fitted and judged."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidate import USUAL, Extension, beginning, extended, unknowns_of
from continuum.discovery.held_out import held_out_misfits
from continuum.discovery.price_of_own import OneForAll, own_prices
from continuum.discovery.question import Question
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.simulator import Simulator
from continuum.identification.arrow_least_squares import FitStatus
from continuum.identification.fit import Fit, fit
from continuum.identification.free import Free, FreeSpace
from continuum.identification.window_settling import STEPS

TOLERANCES = Tolerances(1e-3, 1e-4, 0.01)  # over a window errors stay below a hundredth of a degree


@dataclass(frozen=True, eq=False)
class Trial:
    """How well one extension does.

    Attributes:
        extension: what was tried.
        status: of the fit.
        unknowns, coordinates: of the fit, (k,); amounts: what they add to the model's values, in their own units.
        own: coordinates of every window's own unknowns.
        cost: of the fit.
        held_out: misfit of each run's windows when the other runs predict it; of a right model about ``sizes``.
        sizes: number of errors in each of these windows, less its own unknowns.
        simulations: how many runs were simulated.
        promised: by how much the cost would fall with more iterations, were the errors linear.
        saved: by effect, what it saves to take its values of all recordings for the same, where that is the less dear.
    """

    extension: Extension
    status: FitStatus
    unknowns: tuple[Free, ...]
    coordinates: Array
    amounts: Array
    own: tuple[Array, ...]
    cost: float
    held_out: tuple[Array, ...]
    sizes: tuple[Array, ...]
    simulations: int
    promised: float = 0.0
    saved: Mapping[str, OneForAll] = field(default_factory=dict)

    @property
    def misfit(self) -> float:
        """All of it."""
        return float(sum(run.sum() for run in self.held_out))

    @property
    def one_for_all(self) -> OneForAll:
        """What all effects save together."""
        saved = self.saved.values()
        return OneForAll(sum(one.unknowns for one in saved), sum(one.misfit for one in saved))

    @property
    def relative(self) -> Array:
        """Misfit of every window in units of its size, (n_windows,): about 1 for a right model."""
        return np.concatenate(self.held_out) / np.concatenate(self.sizes)


def fit_extension(
    question: Question,
    extension: Extension,
    near: Trial | None = None,
    iterations: int = 12,
    seekings: int = 2,
    steps: int = STEPS,
    to_the_end: bool = False,
    part: float = USUAL,
) -> Fit:
    """Fit the extended model to all runs.

    Args:
        question: data and model.
        extension: effects beyond Eq. 12.
        iterations: of the fit, at most.
        near: a trial to start from; what is not among its unknowns starts absent or at a part of a typical size.
        seekings, steps: of the fit, at most.
        to_the_end: as of `continuum.identification.fit.fit`.
        part: of a typical size, as of `beginning`.
    """
    model = extended(question.model, extension)
    added = [u for a in extension for u in unknowns_of(a, model.n_joints, len(question.recordings))]
    free = [*question.baseline, *added]
    begin = beginning(FreeSpace(model, free), len(added), part)
    there = {} if near is None else dict(zip(near.unknowns, map(float, near.coordinates), strict=True))
    for i, unknown in enumerate(free):
        begin[i] = there.get(unknown, begin[i])
    own = near.own if near is not None and near.own else None
    simulator = Simulator(model, TOLERANCES)
    return fit(
        simulator,
        question.recordings,
        question.noise,
        free,
        begin,
        iterations=iterations,
        own=own,
        seekings=seekings,
        steps=steps,
        to_the_end=to_the_end,
    )


def judged(extension: Extension, fitted: Fit) -> Trial:
    """The trial of an extension that was fitted."""
    held_out = held_out_misfits(fitted)
    own = np.array([spread.size for spread in fitted.unknowns.own_spread])
    sizes = np.maximum(np.concatenate([run.errors_by_window for run in fitted.runs]) - own, 1.0)
    return Trial(
        extension,
        fitted.status,
        fitted.space.unknowns,
        fitted.coordinates,
        fitted.space.scale * fitted.coordinates,
        tuple(fitted.unknowns.own),
        fitted.cost,
        tuple(held_out),
        tuple(np.split(sizes, np.cumsum([group.size for group in held_out])[:-1])),
        fitted.simulations,
        fitted.promised,
        own_prices(fitted)[1] if fitted.parts else {},
    )
