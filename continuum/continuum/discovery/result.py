"""The answer of a diagnosis: verdict, shares, missing torque, values with intervals, and the extended model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from continuum.arrays import Array
from continuum.discovery.decision import Kind, Verdict
from continuum.discovery.fit_result import OpenLoop
from continuum.dynamics.model import Model
from continuum.identification.estimate import Estimate
from continuum.languages import Message
from continuum.recordings.recording import Recording

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_FEW = 2  # runs, which are less work than taking an arm apart


@dataclass(frozen=True)
class Share:
    """Fraction of the distance between open-loop error and noise that an effect closes, with its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Cause:
    """An effect of a set.

    Attributes:
        effect: name of the effect.
        joints: joints at which it acts, from 0; None if it acts on the whole arm.
        share: fraction of the open-loop error that it closes.
        gain: amount by which it raises the set's log-evidence.
        estimates: estimates of its values.
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
class Detectable:
    """The smallest size of an effect that these recordings would have shown.

    Attributes:
        effect, joints: name and joints of the effect; joints are None if it acts on the whole arm.
        parameter: parameter that gives its size.
        unit: SI unit of the parameter.
        typical: size that it has where it matters [unit].
        smallest: size from which it would have been named with a probability of 80 % [unit]; infinite if at no size.
        reason: why it is not shown at its typical size, one sentence; empty if it is.
    """

    effect: str
    joints: tuple[int, ...] | None
    parameter: str
    unit: str
    typical: float
    smallest: float
    reason: str

    @property
    def is_shown(self) -> bool:
        """Whether its typical size would have been shown."""
        return self.smallest <= self.typical

    @property
    def label(self) -> str:
        """Effect and joints, from 1."""
        return self.effect + ("" if self.joints is None else "@" + ",".join(str(j + 1) for j in self.joints))


@dataclass(frozen=True)
class Experiment:
    """An informative further run.

    Attributes:
        name: a few words.
        instruction: what to do, one or two sentences for a mechanic.
        separates: expected difference of log open-loop error between the two likeliest sets; NaN if there is only one.
        runs: number of such runs after which only one of them is expected to stay possible; 0 if no number suffices.
        shows: labels of effects that these recordings cannot show at their typical sizes but this run would.
    """

    name: str
    instruction: str
    separates: float
    runs: int
    shows: tuple[str, ...]


@dataclass(frozen=True)
class HandTest:
    """A value that would distinguish the two likeliest sets if measured by hand.

    Attributes:
        effect, parameter, joint: the value; joint from 0, None if it belongs to none.
        unit: SI unit.
        sd: standard deviation of the usual instrument [unit].
        apart: number of standard deviations by which the sets differ about it.
        decides: whether that is enough to exclude one of them with a probability of 80 %.
        instruction: what to do, one or two sentences for a mechanic.
    """

    effect: str
    parameter: str
    joint: int | None
    unit: str
    sd: float
    apart: float
    decides: bool
    instruction: str

    @property
    def name(self) -> str:
        """Name as in tables, joints from 1."""
        return f"{self.effect}.{self.parameter}" + (f"[{self.joint + 1}]" if self.joint is not None else "")


@dataclass(frozen=True)
class Removal:
    """An effect that can be taken off the arm; the same recordings without it leave one of the two likeliest sets.

    Attributes:
        effect: name of the effect.
        instruction: what to do, one sentence for a mechanic.
    """

    effect: str
    instruction: str


@dataclass(frozen=True)
class Diagnosis:
    """The answer.

    Attributes:
        verdict: the verdict.
        sets: causes of each possible set, the most probable first; for an unknown cause, the set that helps most.
        closed: share that the best set closes.
        sigma: standard deviation of the missing torque before and after, (n,) each [N m].
        missing: smoothed missing torque of every run before and after, (n_times, n) each [N m].
        estimates: estimates of the model's parameters.
        before, after: open-loop simulations of the refitted and of the extended model.
        refitted_model, extended_model: these models with their values.
        recordings: recordings that were diagnosed.
        power: smallest size of each effect that would have been shown in addition to the best set.
        experiments: informative further runs, the best first.
        hand_tests: values that would distinguish the likeliest sets if measured by hand, the best first.
        correlation: names of the best set's values and their posterior correlations, (k, k).
        notes: notes on the data, one sentence each.
        tolerance: open-loop error up to which a model is adequate [rad].
        seconds: processor time [s].
        removals: effects whose removal would distinguish the likeliest sets.
        measured: values that were measured by hand, as text; every model here has them.
        without: effects that were taken off the arm.
        zeroed: recordings before which the sensors' zeros were set by hand.
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
    power: tuple[Detectable, ...]
    experiments: tuple[Experiment, ...]
    hand_tests: tuple[HandTest, ...]
    correlation: tuple[tuple[str, ...], Array]
    notes: tuple[str, ...]
    tolerance: float
    seconds: float
    removals: tuple[Removal, ...] = ()
    measured: tuple[str, ...] = ()
    zeroed: tuple[str, ...] = ()
    without: tuple[str, ...] = ()

    @property
    def known(self) -> tuple[Message, ...]:
        """Facts on which the answer rests in addition to the recordings, a phrase each."""
        return (
            *(Message("{measured} is in every model", measured=one) for one in self.measured),
            *(Message("the sensors' zeros were set by hand before {recording}", recording=one) for one in self.zeroed),
            *(Message("{effect} was taken off the arm", effect=one) for one in self.without),
        )

    @property
    def causes(self) -> tuple[Cause, ...]:
        """Causes of the most probable set, or of the one that helps most."""
        return self.sets[0] if self.sets else ()

    @property
    def shares(self) -> Mapping[str, Share]:
        """Share that each effect of the best set closes, and the share that stays unknown; the values add up to one."""
        found = {cause.label: cause.share for cause in self.causes}
        rest = 1 - sum(share.value for share in found.values())
        return found | {"unknown": Share(rest, 1 - self.closed.high, 1 - self.closed.low)}

    @property
    def n_joints(self) -> int:
        """Number of joints of the arm."""
        return self.recordings[0].n_joints

    @property
    def separating(self) -> Experiment | HandTest | Removal | None:
        """What distinguishes the two likeliest sets with the least work; None if nothing does.

        It is a run made once or twice, else a measurement by hand, else more runs, else all runs without an effect.
        """
        run = next((one for one in self.experiments if one.runs), None)
        test = next((one for one in self.hand_tests if one.decides), None)
        if run is not None and (run.runs <= _FEW or test is None):
            return run
        return test or next(iter(self.removals), None)

    @property
    def is_extended(self) -> bool:
        """Whether the extended model has an effect that the refitted one lacks."""
        return bool(self.causes)

    def plot(self) -> Figure:
        """Plot measured and simulated joint angles, and the missing torque before and after."""
        from continuum.discovery.pictures import overview

        return overview(self)


def is_named(kind: Kind) -> bool:
    """Whether a verdict names effects."""
    return kind in (Kind.CAUSE, Kind.AMBIGUOUS)
