"""Diagnoses made by hand, of which every figure is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from dynamics_laws import prototype_model

from continuum.arrays import Array
from continuum.discovery.decision import Kind, Verdict
from continuum.discovery.fit_result import OpenLoop
from continuum.discovery.result import Cause, Detectable, Diagnosis, Share
from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.estimate import Estimate
from continuum.recordings.recording import Recording

N = 3
FLOOR = np.radians(0.2)
TIMES = np.arange(0.0, 1.0, 1 / 60)


def cause(effect: str, *joints: int, share: float = 0.9, value: float = 0.1) -> Cause:
    """An effect at joints from 0, or of the whole arm; its first parameter has a value."""
    name, spec = next(iter(effect_named(effect).parameters.items()))
    joint = joints[0] if len(joints) == 1 else None
    one = Estimate(
        f"{effect}.{name}", joint, "", value, 0.9 * value, 1.1 * value, spec.unit, spec.meaning,
        spec.default or 0.0, spec.lower, spec.upper,
    )  # fmt: skip
    return Cause(effect, joints or None, Share(share, share - 0.1, share + 0.1), 30.0, (one,))


def detectable(effect: str, *joints: int, smallest: float = 0.5) -> Detectable:
    """An effect that would have been shown from so many typical sizes on."""
    name, spec = next(iter(effect_named(effect).parameters.items()))
    typical = spec.typical or 1.0
    reason = "It changes the readings, but acts in too few of them." * (smallest > 1)
    return Detectable(effect, joints or None, name, spec.unit, typical, smallest * typical, reason)


def diagnosis(
    kind: Kind,
    *sets: Sequence[Cause],
    names: Sequence[str] = ("run_1", "run_2"),
    before: float = 2.0,
    after: float = 0.3,
    power: Sequence[Detectable] = (),
) -> Diagnosis:
    """An answer about swinging joints.

    Args:
        kind: of verdict.
        sets: as `Diagnosis.sets`.
        names: of recordings.
        before, after: root mean square errors of the refitted and of the extended model, alike everywhere [degrees].
        power: as in `Diagnosis`.
    """
    runs = tuple(Recording(name, TIMES, swing(1.0 + r)) for r, name in enumerate(names))
    loops = [
        OpenLoop(tuple(run.theta + error(size) for run in runs), float(FLOOR), float(FLOOR)) for size in (before, after)
    ]
    torques = [
        tuple(np.full((TIMES.size, N), size) * 1e-3 * np.sin(9 * TIMES)[:, None] for _ in runs) for size in (9, 2)
    ]
    named = kind in (Kind.CAUSE, Kind.AMBIGUOUS)
    keys = tuple(tuple((c.effect, c.joints) for c in one) for one in sets)
    p = tuple(np.array([0.99, *(0.01,) * (len(sets) - 1)])[: len(sets)])
    model = prototype_model(N)
    stiffness = Estimate("stiffness", None, "", 1.2, np.nan, np.nan, "N m/rad", "stiffness of a spring", 1.1, 0.0, 1e4)
    return Diagnosis(
        Verdict(kind, keys if named else ((),), p if named else (1.0,), True), tuple(tuple(one) for one in sets),
        Share(0.9, 0.8, 1.0), (np.array([9e-3, 5e-3, 2e-3]), np.array([2e-3, 1e-3, 1e-3])), (torques[0], torques[1]),
        (stiffness,), loops[0], loops[1] if sets else loops[0], model, model, runs, tuple(power), (), (),
        (("stiffness", "joint_stiffness.excess[2]"), np.array([[1.0, -0.4], [-0.4, 1.0]])), ("a remark",),
        float(3 * FLOOR), 1.0,
    )  # fmt: skip


def swing(size: float) -> Array:
    """Angles of three joints, (n_times, 3) [rad]."""
    return np.asarray(0.1 * size * np.exp(-TIMES)[:, None] * np.cos(np.outer(TIMES, (6.0, 9.0, 13.0))))


def error(size: float) -> Array:
    """Residuals with a root mean square [degrees] at every joint, (n_times, 3) [rad]."""
    return np.full((TIMES.size, N), np.radians(size))


def with_names(result: Diagnosis, *names: str) -> Diagnosis:
    """The same, its recordings called otherwise."""
    runs = tuple(replace(run, name=name) for run, name in zip(result.recordings, names, strict=True))
    return replace(result, recordings=runs)
