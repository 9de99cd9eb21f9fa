"""Whether the arm bends towards the cable that pulls more; cable 1 bends it towards positive angles.

  r = correlation of u_1 - u_2 with the mean of all joint angles, both as means over half a second, taken twice

Such means leave little of fast motions, which may swing against what drives them: of 3 Hz, a twentieth. If r is below
-1/2, the columns of the cables or the signs of the angles are swapped: a fit would take long and end with parameters at
their bounds.
"""

from __future__ import annotations

import numpy as np

from continuum.errors import InvalidValueError
from continuum.recordings.recording import Recording

_OPPOSED = -0.5
_LENGTH = 0.5  # s; the arm swings in less
_PULLED, _BENT = 2.0, np.deg2rad(1.0)  # N and rad, least changes of the means: more than sensor errors


def side_correlation(run: Recording) -> float | None:
    """Return r of a run, -1 to 1; None if it is too short or hardly pulled."""
    rows = max(1, round(_LENGTH / float(np.median(np.diff(run.times)))))
    if run.tensions is None or not run.is_driven or run.times.size < 3 * rows:
        return None
    u = run.pull.over(run.times)
    evenly = np.full(rows, 1 / rows)
    twice = np.convolve(evenly, evenly)
    difference, bend = (np.convolve(x, twice, "valid") for x in (u[:, 0] - u[:, 1], run.theta.mean(axis=1)))
    if np.ptp(difference) < _PULLED or np.ptp(bend) < _BENT:
        return None
    return float(np.corrcoef(difference, bend)[0, 1])


def refuse_swapped_cables(run: Recording) -> None:
    """Refuse a run in which the arm bends away from the cable that pulls more.

    Raises:
        InvalidValueError: the arm bends away from it.
    """
    r = side_correlation(run)
    if r is not None and r < _OPPOSED:
        cable_1 = "cable 1 bends the arm towards positive angles: swap u1 and u2, or the signs of the angles"
        allowed = f"above {_OPPOSED}, as {cable_1}"
        raise InvalidValueError(f"{run.name}: correlation of bend with u1 - u2", round(r, 2), allowed)
