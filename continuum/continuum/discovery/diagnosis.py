"""`diagnose`: from recordings and a model to an answer."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace

import numpy as np

from continuum.arrays import Array
from continuum.discovery.candidates import examine, silent
from continuum.discovery.decision import Kind, Verdict, closed, decide, noise_in_segments
from continuum.discovery.detectable import detectable
from continuum.discovery.estimates import baseline_estimates, correlation_of, estimates_of
from continuum.discovery.examination import Examination, Examined
from continuum.discovery.experiments import experiments, rivals
from continuum.discovery.extended_model import model_of
from continuum.discovery.hand_measurement import HandMeasurement, check_measured, with_measured
from continuum.discovery.hand_tests import hand_tests, removals
from continuum.discovery.missing_torque import missing_torque
from continuum.discovery.power import powers
from continuum.discovery.refit import check_recordings
from continuum.discovery.result import Cause, Diagnosis, Share, is_named
from continuum.discovery.search import Progress, with_library
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model import Model
from continuum.errors import InvalidValueError
from continuum.languages import Message
from continuum.recordings.rate_ratio import odd_rates
from continuum.recordings.recording import Recording
from continuum.significant_digits import rounded

TOLERANCE = 3.0
"""Default open-loop error up to which a model is adequate, in units of the angles' noise: an error that no single
reading shows. The sensors' slow error is accepted in any case."""

_PULLED = 2.4
"""Standard deviations from a measured value beyond which only the bound of 2.5 holds the fit."""
_SEARCH = 0.65  # fraction of a diagnosis's time that the search takes if power is computed too


def diagnose(
    recordings: Sequence[Recording],
    model: Model,
    effects: Sequence[str] | None = None,
    tolerance: float | None = None,
    progress: Progress = silent,
    with_power: bool = True,
    measured: Sequence[HandMeasurement] = (),
    zeroed: Collection[int] = (),
    without: Collection[str] = (),
) -> Diagnosis:
    """Diagnose a model by measured data.

    Args:
        recordings: runs of the arm.
        model: model with nominal values.
        effects: names of the effects to try; all installed effects if None.
        tolerance: open-loop error up to which a model is adequate [rad]; TOLERANCE times the noise if None.
        progress: called with the current step and the fraction of all work that is done.
        measured: values of effects that were measured by hand; every model of the diagnosis has them.
        zeroed: numbers, from 0, of the recordings before which the sensors' zeros were set by hand; sets that
            contradict these are excluded.
        without: effects that were taken off the arm.
        with_power: whether to compute what the recordings would have shown and which run would show more.

    Raises:
        InvalidValueError: no recording, a number of joints or kind of inputs other than the model's, or a recording
            given twice.
    """
    began = time.process_time()
    check_recordings(recordings, model)
    if tolerance is not None and not 0 < tolerance < np.inf:
        raise InvalidValueError("tolerance", tolerance, "an angle > 0 [rad]")
    if not set(zeroed) <= set(range(len(recordings))):
        raise InvalidValueError("zeroed recordings", sorted(zeroed), f"0 to {len(recordings) - 1}")
    check_measured(measured, model)
    names = _left(effects, without, measured)
    model = with_measured(model, measured)
    search = _SEARCH if with_power else 1.0
    found = examine(recordings, model, names, lambda what, part: progress(what, search * part), measured, zeroed)
    progress(Message("deciding"), search)
    answer, best = _answer(found, recordings, model, tolerance)
    if with_power:
        progress(Message("power of the recordings"), 0.7)
        named = {key for one in (*answer.verdict.sets, answer.verdict.helps) for key in one}
        library = with_library(found.problem, best.found).lin.library
        known = powers(found.judge, best.fit, library, found.baseline.fit) if best.fit.completed else []
        power = detectable(found.problem, [one for one in known if one.hypothesis.key not in named])
        progress(Message("next experiment"), 0.85)
        compared = rivals([found.by_key[frozenset(key)] for key in answer.verdict.sets] or [best])
        answer = replace(
            answer, power=power, experiments=experiments(found, compared, library, recordings, power),
            hand_tests=hand_tests(found, compared), removals=removals(compared),
        )  # fmt: skip
    return replace(answer, without=tuple(without), seconds=time.process_time() - began)


def _left(
    effects: Sequence[str] | None, without: Collection[str], measured: Sequence[HandMeasurement]
) -> Sequence[str]:
    """Return the names of the effects to try."""
    for name in without:
        if not effect_named(name).removal:
            able = [one for one in effect_names() if effect_named(one).removal]
            raise InvalidValueError("effect taken off the arm", name, f"one that can be: {', '.join(able)}")
        if name in {one.effect for one in measured}:
            raise InvalidValueError("measured effect", name, "an effect that was not taken off the arm")
    names = effect_names() if effects is None else effects
    return [name for name in names if name not in without]


def _answer(
    found: Examination,
    recordings: Sequence[Recording],
    model: Model,
    tolerance: float | None,
) -> tuple[Diagnosis, Examined]:
    """Return the answer without power, and the best set."""
    problem, base = found.problem, found.baseline
    floor = found.judge.floor
    accepted = max(TOLERANCE * floor, float(np.max(problem.noise.slow))) if tolerance is None else tolerance
    others = [one.candidate for one in found.others]
    before = found.judge.whole(base.fit)
    errors = [before.error(r, run.theta) for r, run in enumerate(recordings)]
    whole = float(np.sqrt(np.mean(np.square(errors))))
    verdict = decide(base.candidate, others, floor, accepted, whole, tolerance is not None)
    odd = odd_rates(recordings)
    if odd:  # no fit to readings that contradict each other can be trusted
        verdict = Verdict(Kind.UNKNOWN, (), (), False)
    keys = verdict.sets if is_named(verdict.kind) else ((verdict.helps,) if verdict.helps else ())
    sets = tuple(_causes(found, found.by_key[frozenset(key)]) for key in keys)
    best = found.by_key[frozenset(keys[0])] if keys else base
    share = _share(found, best)
    sigma, torque = less_sigma, less_torque = missing_torque(problem, base.found)
    after = before
    if best is not base:
        less_sigma, less_torque = missing_torque(problem, best.found)
        after = found.judge.whole(best.fit)
    answer = Diagnosis(
        verdict, sets, share, (sigma, less_sigma), (torque, less_torque), baseline_estimates(problem, best.fit), before,
        after, model_of(problem, base.fit.state, (), model),
        model_of(problem, best.fit.state, best.candidate.effects, model), tuple(recordings),
        (), (), (), correlation_of(best.fit), (*odd, *_notes(recordings, found, best)), accepted, 0.0,
        (), tuple(map(str, found.problem.measured)), tuple(recordings[k].name for k in sorted(found.problem.zeroed)),
    )  # fmt: skip
    return answer, best


def _share(found: Examination, one: Examined) -> Share:
    noise = noise_in_segments([each.candidate for each in (found.baseline, *found.others)], found.judge.floor)
    return Share(*closed(found.baseline.candidate, one.candidate, noise))


def _causes(found: Examination, one: Examined) -> tuple[Cause, ...]:
    """Return the effects of a set; its closed share is divided in proportion to what each adds to the others."""
    evidence, chosen = one.found.lin.evidence, one.found.chosen
    whole, total = _share(found, one), evidence.total(chosen, with_constraints=True)
    errors = {each.found.key: each.fit.error for each in (found.baseline, *found.others)}
    rest = [tuple(h for h in chosen if h is not left) for left in chosen]
    closes = np.array([errors.get(frozenset(h.key for h in part), np.inf) - one.fit.error for part in rest])
    parts: Array = np.full(len(chosen), 1 / len(chosen))
    if np.all(np.isfinite(closes)) and np.sum(np.maximum(closes, 0)) > 0:
        parts = np.maximum(closes, 0) / np.sum(np.maximum(closes, 0))
    return tuple(
        Cause(
            h.effect,
            h.joints,
            Share(whole.value * part, whole.low * part, whole.high * part),
            float(total - evidence.total(others, with_constraints=True)),
            estimates_of(found.problem, one.fit, h),
        )
        for h, others, part in zip(chosen, rest, parts, strict=True)
    )


def _notes(recordings: Sequence[Recording], found: Examination, best: Examined) -> tuple[str, ...]:
    notes = [Message("{name}: {note}", name=run.name, note=note) for run in recordings for note in run.notes]
    if any(run.is_driven for run in recordings):
        held = all(run.held for run in found.problem.runs)
        notes.append(
            Message("inputs are assumed to hold until their next row")
            if held
            else Message("inputs are assumed to change linearly from row to row")
        )
    if len(recordings) < 3:
        notes.append(Message("Too few recordings to show whether the verdict holds for other recordings."))
    notes += _pulled(found, best)
    local = sorted({h.effect for h in best.found.chosen if h.local})
    if local:
        notes.append(
            Message(
                "{effects}: each recording has its own value, which a model file leaves at zero",
                effects=", ".join(local),
            )
        )
    return tuple(notes)


def _pulled(found: Examination, best: Examined) -> Iterator[Message]:
    """Yield a note on each measured value that the recordings contradict by more than its standard deviation allows."""
    fit = best.fit
    for one in found.problem.measured:
        for unknown, value in zip(fit.unknowns.common, fit.values.common, strict=True):
            if one.key in unknown.places and abs(value - unknown.mean) > _PULLED * one.sd:
                yield Message(
                    "{measured}: the recordings call for {value} or beyond, more than {limit:g} standard "
                    "deviations away; measure it again, as no other result is certain until this is resolved",
                    measured=str(one), value=rounded(one.value + value, 4), limit=_PULLED,
                )  # fmt: skip
