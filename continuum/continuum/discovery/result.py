"""The answer of a diagnosis: verdict, shares, missing torque, values with intervals, and the extended model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from continuum.arrays import Array
from continuum.discovery.decision import Kind, Verdict
from continuum.discovery.fitted import OpenLoop
from continuum.dynamics.model import Model
from continuum.recordings.recording import Recording

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class Estimate:
    """One value with its 95 % interval.

    Attributes:
        name: parameter of Eq. 12, or effect and parameter with a dot between.
        joint: from 0; None where it belongs to none, or to all alike.
        recording: which has it for itself; empty where all have the same.
        value, low, high: in its unit; the ends are NaN where no interval is known.
        unit: SI.
        meaning: one sentence.
    """

    name: str
    joint: int | None
    recording: str
    value: float
    low: float
    high: float
    unit: str
    meaning: str

    def __str__(self) -> str:
        where = "" if self.joint is None else f"[{self.joint + 1}]"
        return f"{self.name}{where}" + f" in {self.recording}" * bool(self.recording)


@dataclass(frozen=True)
class Share:
    """Part of the distance between the open-loop error and the noise that an effect closes, with its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Cause:
    """An effect of a set.

    Attributes:
        effect: by name.
        joints: at which it acts, from 0; None where it belongs to the whole arm.
        share: what it closes of the open-loop error.
        gain: by which it raises the set's log-evidence.
        estimates: of its values.
    """

    effect: str
    joints: tuple[int, ...] | None
    share: Share
    gain: float
    estimates: tuple[Estimate, ...]

    @property
    def label(self) -> str:
        """Effect and joints, from 1."""
        where = "" if self.joints is None else "@" + ",".join(str(j + 1) for j in self.joints)
        return self.effect + where


@dataclass(frozen=True)
class Diagnosis:
    """The answer.

    Attributes:
        verdict: what is said.
        sets: causes of each possible set, the most probable first; of an unknown cause, the set that helps most.
        closed: share that the best set closes.
        sigma: standard deviation of the missing torque before and after, (n,) each [N m].
        missing: smoothed missing torque of every run before and after, (n_times, n) each [N m].
        estimates: of the model's own parameters.
        before, after: open-loop simulations of the refitted and of the extended model.
        refitted_model, extended_model: with their values.
        recordings: what was diagnosed.
        notes: on the data, one sentence each.
        tolerance: open-loop error up to which a model is adequate [rad].
        seconds: of processor time.
    """

    verdict: Verdict
    sets: tuple[tuple[Cause, ...], ...]
    closed: Share
    sigma: tuple[Array, Array]
    missing: tuple[tuple[Array, ...], tuple[Array, ...]]
    estimates: tuple[Estimate, ...]
    before: OpenLoop
    after: OpenLoop
    refitted_model: Model
    extended_model: Model
    recordings: tuple[Recording, ...]
    notes: tuple[str, ...]
    tolerance: float
    seconds: float

    @property
    def causes(self) -> tuple[Cause, ...]:
        """Of the most probable set, or of the one that helps most."""
        return self.sets[0] if self.sets else ()

    @property
    def shares(self) -> Mapping[str, Share]:
        """What each effect of the best set closes, and what stays unknown; the values add up to one."""
        found = {cause.label: cause.share for cause in self.causes}
        rest = 1 - sum(share.value for share in found.values())
        return found | {"unknown": Share(rest, 1 - self.closed.high, 1 - self.closed.low)}

    @property
    def is_extended(self) -> bool:
        """Whether the extended model has an effect that the refitted one has not."""
        return bool(self.causes)

    def plot(self) -> Figure:
        """Measured and simulated joint angles, and the missing torque before and after."""
        from continuum.discovery.pictures import overview

        return overview(self)


def is_named(kind: Kind) -> bool:
    """Whether a verdict names effects."""
    return kind in (Kind.CAUSE, Kind.AMBIGUOUS)
