"""The unit of an Xsens DOT's time stamps, and whether they can be original.

A DOT stores 1 to 120 readings a second in steps of equal length, some of which are lost (User Manual XD0502P, section
4). Its stamps count microseconds in files of the app; files of the PC's SDK were seen to count 100 us. Stamps that were
rounded by another program's float format have steps that no rate explains: angles would be wrong as much as the rate.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from continuum.errors import FileError

RATES = (1, 4, 10, 12, 15, 20, 30, 60, 120)
"""Readings a second that a DOT can store."""

_UNITS = (1, 100)  # possible length of a tick [us]
_NEAR = 0.02  # relative error of a rate: crystals are within 1e-4, whole ticks of 100 us at 120 Hz within 6e-3
_UNEVEN = 0.1  # of a step, beyond which a stamp is not its reading's
_FEW = 8  # fewest steps that can be judged


def microseconds(path: Path, ticks: NDArray[np.int64], rate: float | None) -> tuple[NDArray[np.int64], str]:
    """Return the stamps in microseconds, and a note if they counted another unit.

    Args:
        path: path of the file, for messages.
        ticks: unwrapped stamps, (k,).
        rate: readings a second from the file's header; None if it has none.

    Raises:
        FileError: in no unit do the stamps fit a rate of a DOT or that of the header, or a DOT lacks the header's rate.
    """
    steps = np.diff(ticks)
    steps = steps[steps > 0]
    if steps.size < _FEW:
        return ticks, ""
    if rate is not None and rate not in RATES:
        raise FileError(path, f"OutputRate is {rate:g}; a DOT stores {', '.join(map(str, RATES))} readings a second")
    wanted = RATES if rate is None else (rate,)
    fits = [(unit, one) for unit in _UNITS for one in wanted if _fits(steps * unit, one)]
    if not fits:
        found = 1e6 / float(np.median(steps))
        by = f"the header says {rate:g}" if rate is not None else f"a DOT stores {', '.join(map(str, RATES))}"
        uneven = np.percentile(steps, [10, 90]) / 1e3
        raise FileError(
            path,
            f"SampleTimeFine makes {found:.4g} readings a second in steps of {uneven[0]:g} to {uneven[1]:g} ms if it "
            f"counts microseconds, {by}: the stamps are not the sensor's, were rounded, or have another unit",
        )
    unit, one = fits[0]
    if unit == 1:
        return ticks, ""
    if rate is None:
        raise FileError(
            path,
            f"SampleTimeFine makes {unit * one:g} readings a second if it counts microseconds, "
            f"{one} if it counts {unit} us: a line OutputRate in the header must say which",
        )
    return ticks * unit, f"SampleTimeFine counts {unit} us: {rate:g} readings a second, as the header says"


def _fits(steps: NDArray[np.int64], rate: float) -> bool:
    """Whether most steps [us] are those of a rate [1/s], or whole multiples if readings were lost."""
    counts = steps * rate / 1e6
    wrong = np.abs(counts - np.rint(counts)) > _UNEVEN
    return bool(np.mean(wrong) < 0.5 * _UNEVEN and abs(np.median(counts) - 1) < _NEAR)
