"""Compile what a first diagnosis of the prototype needs, or load it from its cache, before somebody waits for it.

`python3 -m continuum.discovery.warm_up` does it once for all programs after an installation.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from continuum.discovery.diagnosis import diagnose
from continuum.dynamics.compiled.equations import CompiledEquations
from continuum.dynamics.dry_friction import with_dry_friction
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.estimation.structure import Structure, absent_values
from continuum.recordings.recording import Recording

_TIMES = np.arange(40) / 120  # s
_NOISE = 1e-3  # rad, and ten times as much in rad/s
_BEND = np.radians([4.0, 6.0, 8.0, 6.0, 4.0])


def warm_up() -> None:
    """Compile the prototype's equations with all effects, with cables that pull and without, and diagnose for once."""
    model = load_model("lamecc_prototype.yaml")
    for with_tension in (False, True):
        structure = Structure(with_dry_friction(model), with_tension=with_tension)
        structure.compile()
        _compile_simulators(structure)
    for recording in _recordings(model):
        diagnose([recording], model)


def _compile_simulators(structure: Structure) -> None:
    """Of open-loop fits, with ordinary differences of parts and one effect more; of screening, with all effects."""
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
    """A release without rates, and a pull with them, of a model whose springs are softer."""
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
