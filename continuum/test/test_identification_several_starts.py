"""A fit from starts over all of the prior: evenly spread, reproducible, and the best one wins."""

from __future__ import annotations

import numpy as np
import pytest
from identification_laws import releases, small_simulator, white_noise

from continuum.discovery.trial import TOLERANCES
from continuum.errors import InvalidValueError
from continuum.identification.arrow_least_squares import FitStatus
from continuum.identification.fit import fit
from continuum.identification.free import Free, FreeSpace
from continuum.identification.several_starts import fit_from_several, spread_starts

TRUTH = {"stiffness": 1.5, "viscous_friction": 0.025, "coulomb_friction": 0.05}
FREE = tuple(Free(name) for name in TRUTH)
SPACE = FreeSpace(small_simulator().model, FREE)


@pytest.mark.parametrize("starts", [1, 2, 9])
def test_starts_are_the_models_values_and_others_spread_evenly_within_the_bounds(starts: int) -> None:
    found = spread_starts(SPACE, starts, np.random.default_rng(0))
    assert found.shape == (starts, len(FREE))
    assert not np.any(found[0])
    assert np.all((found >= SPACE.lower) & (found <= SPACE.upper))
    np.testing.assert_array_equal(found, spread_starts(SPACE, starts, np.random.default_rng(0)))
    for column, lower in zip(found[1:].T, SPACE.lower, strict=True):
        inside = column[column > lower]
        assert np.unique(inside).size == inside.size  # of every unknown each quantile once


def test_the_best_of_several_starts_is_at_least_as_good_as_one() -> None:
    simulator, runs = small_simulator(None, TOLERANCES), releases(2, small_simulator(), 0, TRUTH)
    one = fit(simulator, runs, white_noise(), FREE)
    several = fit_from_several(simulator, runs, white_noise(), FREE, np.random.default_rng(3))
    assert several.best.status is FitStatus.CONVERGED
    assert several.best.cost <= one.cost + 0.1
    assert several.costs.size == 5
    assert np.min(several.costs) <= several.costs[0]
    for name, true in TRUTH.items():
        assert several.best.value(Free(name)) == pytest.approx(true, rel=0.1)


def test_a_start_in_the_wrong_valley_is_left() -> None:
    """The model's own values are so wrong that few iterations lead nowhere from there."""
    wrong = small_simulator().model.with_values({"stiffness": 30.0, "coulomb_friction": 0.9})
    simulator = small_simulator(None, TOLERANCES).around(wrong)
    runs = releases(2, small_simulator(), 0, TRUTH)
    several = fit_from_several(simulator, runs, white_noise(), FREE, np.random.default_rng(1), starts=8, short=3)
    assert np.argmin(several.costs) != 0
    assert several.best.value(Free("stiffness")) == pytest.approx(TRUTH["stiffness"], rel=0.1)


def test_the_best_start_goes_on() -> None:
    """From the model's own values, which are wrong, one more iteration would not come as far."""
    wrong = small_simulator().model.with_values({"stiffness": 30.0, "coulomb_friction": 0.9})
    simulator = small_simulator(None, TOLERANCES).around(wrong)
    runs = releases(2, small_simulator(), 0, TRUTH)
    random = np.random.default_rng(1)
    several = fit_from_several(simulator, runs, white_noise(), FREE, random, starts=8, iterations=1, short=3)
    assert several.best.cost <= np.min(several.costs) + 1e-6 < several.costs[0]


def test_no_start_is_refused() -> None:
    with pytest.raises(InvalidValueError, match="starts is 0; allowed: 1 or more"):
        fit_from_several(small_simulator(), (), white_noise(), FREE, np.random.default_rng(0), starts=0)
