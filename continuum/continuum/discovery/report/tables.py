"""Tables of the page of a diagnosis: shares and errors."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from continuum.arrays import Array
from continuum.discovery.fit_result import OpenLoop
from continuum.discovery.report.cause_sentences import matter_with_value
from continuum.discovery.report.names import capital, label_in_words, sets_in_words, small
from continuum.discovery.report.quantities import percent, percent_interval, with_decimals
from continuum.discovery.result import Cause, Diagnosis, Share
from continuum.discovery.words import joints_in_words
from continuum.identification.nrmse import nrmse
from continuum.languages import Translator


class ShareRow(NamedTuple):
    """An effect, a set or the rest, with the fraction of the error that it closes in percent, and a bar's width."""

    name: str
    id: str
    matter: str
    percent: str
    interval: str
    width: float


class Pair(NamedTuple):
    """A figure of the refitted and of the extended model."""

    before: str
    after: str


class ErrorRow(NamedTuple):
    """Errors of a whole recording: root mean square [degrees], fit [%], Eq. 19, and whether it gets worse."""

    name: str
    rms: Pair
    fit: Pair
    eq19: Pair
    is_worse: bool


class JointRow(NamedTuple):
    """Root mean square error [degrees] and missing torque [mN m] of a joint, and whether its error gets worse."""

    name: str
    rms: Pair
    torque: Pair
    is_worse: bool


def share_rows(result: Diagnosis, tr: Translator) -> list[ShareRow]:
    """Return how much of the open-loop error each effect of the best set closes, and how much stays unexplained."""
    rows = [
        _share(capital(label_in_words(c.label, result.n_joints, tr)), c.label, c.share, [c], tr) for c in result.causes
    ]
    return [*rows, _share(tr("Stays unexplained"), "", result.shares["unknown"], [], tr)]


def set_rows(result: Diagnosis, tr: Translator) -> list[ShareRow]:
    """Return how much of the open-loop error each possible set closes."""
    rows = []
    for causes, name in zip(result.sets, names_of_sets(result, tr), strict=True):
        shares = [cause.share for cause in causes]
        whole = Share(*(math.fsum(getattr(s, end) for s in shares) for end in ("value", "low", "high")))
        rows.append(_share(capital(name), ids(causes), whole, causes, tr))
    return rows


def names_of_sets(result: Diagnosis, tr: Translator) -> list[str]:
    """Return the names of each set's effects, with those common to all sets at the end."""
    names, common = sets_in_words([[cause.label for cause in causes] for causes in result.sets], result.n_joints, tr)
    return [tr(" with ").join(filter(None, [name, common])) for name in names]


def ids(causes: Sequence[Cause]) -> str:
    """Return the names in docs and model files."""
    return " + ".join(cause.label for cause in causes)


def error_rows(result: Diagnosis) -> list[ErrorRow]:
    """Return the errors of each recording."""
    rows = []
    for r, run in enumerate(result.recordings):
        models = (result.before, result.after)
        rms = [one.error(r, run.theta) for one in models]
        scores = [nrmse(one.angles[r], run.theta) for one in models]
        rows.append(
            ErrorRow(
                run.name, _pair(np.degrees(rms), 2), _pair([100 * (1 - score) for score in scores], 1),
                _pair(scores, 3), is_worse(result, *rms),
            )
        )  # fmt: skip
    return rows


def joint_rows(result: Diagnosis, tr: Translator) -> list[JointRow]:
    """Return the errors and missing torques of each joint, over all recordings."""
    errors = [_by_joint(result, one) for one in (result.before, result.after)]
    return [
        JointRow(
            joints_in_words([joint], tr), _pair(np.degrees([before, after]), 2),
            _pair([1e3 * sigma[joint] for sigma in result.sigma], 1), is_worse(result, before, after),
        )
        for joint, (before, after) in enumerate(zip(*errors, strict=True))
    ]  # fmt: skip


def is_worse(result: Diagnosis, before: float, after: float) -> bool:
    """Whether errors [rad] rise by more than the sensors' noise: no reading shows less."""
    if not result.is_extended:
        return False
    return not math.isfinite(after) or after**2 - before**2 > result.before.floor**2


def _share(name: str, label: str, share: Share, causes: Sequence[Cause], tr: Translator) -> ShareRow:
    matter = capital("; ".join(small(matter_with_value(cause, tr)) for cause in causes)) + "." * bool(causes)
    width = 100 * min(max(share.value, 0.0), 1.0) if math.isfinite(share.value) else 0.0
    interval = percent_interval(share.low, share.high, tr)
    return ShareRow(name, label, matter, percent(share.value, tr), interval, round(width, 1))


def _pair(values: Iterable[float], decimals: int) -> Pair:
    """Format two values, without decimals from 100 on."""
    return Pair(*(with_decimals(float(v), decimals * (abs(v) < 100)) if math.isfinite(v) else "–" for v in values))


def _by_joint(result: Diagnosis, loop: OpenLoop) -> Array:
    """Return the root mean square error over the rows of all recordings, (n_joints,) [rad]."""
    residuals = [angles - run.theta for angles, run in zip(loop.angles, result.recordings, strict=True)]
    return np.asarray(np.sqrt(np.mean(np.concatenate(residuals) ** 2, axis=0)))
