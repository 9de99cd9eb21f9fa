"""Compile what a first diagnosis of the prototype needs, or load it from its cache, before a user waits for it.

`python3 -m continuum.discovery.warm_up` does it once for all programs after an installation.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.discovery.diagnosis import diagnose
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.model import ActiveEffect, Model, with_dry_friction
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.estimation.structure import Structure, absent_values
from continuum.recordings.recording import Recording

_TIMES = np.arange(40) / 120  # s
_NOISE = 1e-3  # rad, and ten times as much in rad/s
_BEND = np.radians([4.0, 6.0, 8.0, 6.0, 4.0])


def warm_up() -> None:
    """Compile the prototype's equations with all effects, with and without pulling cables, and diagnose once each."""
    model = load_model("lamecc_prototype.yaml")
    for with_tension in (False, True):
        structure = Structure(with_dry_friction(model), with_tension=with_tension)
        structure.compile()
        _compile_simulators(structure)
    for recording in _recordings(model):
        diagnose([recording], model)


def _compile_simulators(structure: Structure) -> None:
    """Compile equations of open-loop fits, with ordinary differences and one more effect, and those of screening."""
    model, n = structure.model, structure.n
    always = {a.effect.name for a in model.effects if any(p.ordinary for p in a.effect.parameters.values())}
    stateful = [ActiveEffect(along.effect, absent_values(along.effect, n)) for along in structure.stateful.values()]
    fitted = [always | {a.effect.name} for a in (*model.effects, *stateful)]
    plain = {a.effect.name for a in model.effects}
    screened = [plain, *(plain | {a.effect.name} for a in stateful)]
    for names in (always, *fitted, *screened):
        effects = tuple(a for a in (*model.effects, *stateful) if a.effect.name in names)
        equations = CompiledEquations(replace(model, effects=effects))
        _ = equations.residual, equations.stage, equations.sensitivities


def _recordings(model: Model) -> tuple[Recording, Recording]:
    """Return a release without rates and a pull with them, of a model with softer springs."""
    softer = Simulator(model.with_values({"stiffness": 0.8 * float(model.parameters.stiffness[0])}))
    pull = Tensions(_TIMES, np.stack([20.0 * _TIMES, np.zeros(_TIMES.size)], axis=1))
    noise = np.random.default_rng(0).standard_normal((2, _TIMES.size, model.n_joints)) * [[[_NOISE]], [[10 * _NOISE]]]
    released, pulled = softer.run(_BEND, _TIMES), softer.run(_BEND, _TIMES, pull)
    return (
        Recording("released", _TIMES, released.theta + noise[0]),
        Recording("pulled", _TIMES, pulled.theta + noise[0], pulled.theta_rate + noise[1], pull),
    )


if __name__ == "__main__":
    warm_up()
