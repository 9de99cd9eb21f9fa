"""Verdicts, scores of free runs and findings made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from discovery_laws import a_round, trial
from dynamics_laws import prototype_model

from continuum.discovery.findings import Estimate, Findings
from continuum.discovery.judgement import judge
from continuum.discovery.measured_gain import RunScore
from continuum.discovery.verdict import Kind, Verdict
from continuum.dynamics.effect_lookup import effect_named
from continuum.identification.fisher import Identifiability
from continuum.identification.free import Free
from continuum.identification.recording import Recording

GOOD, BAD = trial(), trial(bad=0.3)
PAYLOAD, TILT, DRAG = trial("tip_payload", seed=1), trial("base_tilt", seed=1), trial("quadratic_drag", seed=2)
HALF = trial("tip_payload", bad=0.15)
WORSE = trial("quadratic_drag", bad=0.28)


def judged() -> dict[Kind, Verdict]:
    """One of each kind."""
    return {
        Kind.ADEQUATE: judge(GOOD, [a_round(GOOD, PAYLOAD)]),
        Kind.CAUSE: judge(BAD, [a_round(BAD, PAYLOAD, WORSE)]),
        Kind.AMBIGUOUS: judge(BAD, [a_round(BAD, PAYLOAD, TILT, WORSE)]),
        Kind.UNKNOWN: judge(BAD, [a_round(BAD, HALF, WORSE)]),
    }


RUN = Recording("run_1", np.arange(3) / 120, np.zeros((3, 5)))


def score(name: str, position: float, floor: float = 0.05) -> RunScore:
    return RunScore(name, position, 2 * position, floor, 0.01, None, RUN)


def scores(*positions: float) -> list[RunScore]:
    return [score(f"run_{i}", position) for i, position in enumerate(positions)]


def found(verdict: Verdict) -> Findings:
    """Findings around a verdict."""
    effects = [cause.addition for cause in verdict.causes]
    unknowns = [Free("stiffness"), *(Free(f"{a.effect}.{key}", j) for a in effects
                for key in effect_named(a.effect).parameters for j in a.joints or (None,))]  # fmt: skip
    learnt = Identifiability(tuple(unknowns), np.ones(len(unknowns)), np.eye(len(unknowns)), 10.0, len(unknowns))
    model = prototype_model()
    return Findings(
        verdict=verdict,
        estimates=tuple(Estimate(unknown, 1.0 + i, 0.5 + i, 1.5 + i, "kg") for i, unknown in enumerate(unknowns)),
        others=tuple((Estimate(Free("base_tilt.angle"), 0.1, 0.0, 0.2, "rad"),) for _ in verdict.alternatives),
        identifiability=learnt,
        before=(replace(score("run_1", 0.4), position_interval=(0.3, 0.5)), score("run_2", np.inf)),
        after=(score("run_1", 0.1), score("run_2", 0.2)),
        closed=0.8,
        weakness="two recordings only",
        notes=("run_1: row 7 left out",),
        refitted=model,
        model=model,
        models=(model, model),
    )
