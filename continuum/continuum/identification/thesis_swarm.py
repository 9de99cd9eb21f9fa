"""The identification of the thesis: its five parameters by its particle swarm (Table 2), which minimises Eq. 19."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.model import Model, with_dry_friction
from continuum.dynamics.parameters import PARAMETERS
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.values import parameter_slots
from continuum.identification.estimate import Estimate
from continuum.identification.free import THESIS_PARAMETERS, Free, FreeSpace
from continuum.identification.identified import Identified, with_identified
from continuum.identification.swarm import SwarmSettings, swarm_identification
from continuum.languages import Message
from continuum.recordings.recording import Recording

_TOLERANCES = Tolerances(1e-3, 1e-4, 0.01)  # errors stay below a hundredth of a degree
_SINGLY = ("stiffness", "viscous_friction", "coulomb_friction")  # what may differ by joint


def swarm_parameters(
    recordings: Sequence[Recording],
    model: Model,
    seed: int,
    per_joint: bool = False,
    progress: Callable[[str, float], None] | None = None,
    settings: SwarmSettings | None = None,
) -> Identified:
    """Identify the five parameters within a factor of three of the model's; a swarm gives no intervals.

    Args:
        recordings: runs to fit, each starting at rest from its first measured angles.
        model: model with nominal values.
        seed: seed of the random numbers.
        per_joint: whether every joint has a separate spring, viscous and Coulomb friction.
        progress: called with the current step and the fraction of all work that is done.
        settings: settings of the swarm; those of Table 2 if None.

    Raises:
        InvalidValueError: a recording that does not fit the model.
    """
    settings = settings or SwarmSettings()
    simulator = Simulator(with_dry_friction(model), _TOLERANCES)
    singly = _SINGLY if per_joint else ()
    unknowns = [
        Free(name, joint)
        for name in THESIS_PARAMETERS
        for joint in (range(model.n_joints) if name in singly else (None,))
    ]
    space = FreeSpace(simulator.model, unknowns)
    tell = None if progress is None else partial(progress, "particle swarm")
    found = swarm_identification(simulator, recordings, space, np.random.default_rng(seed), settings, tell)
    values, slots, start = space.common_values(found.coordinates), parameter_slots(simulator.model), model.values()
    estimates = []
    for one in unknowns:
        spec, which = PARAMETERS[one.name], slice(None) if one.joint is None else one.joint
        given = np.broadcast_to(start[one.name], (model.n_joints,))[which]
        value = float(np.mean(values[slots[one.name]][which]))
        estimates.append(
            Estimate(
                one.name, one.joint, "", value, np.nan, np.nan, spec.unit, spec.meaning, float(np.mean(given)),
                spec.lower, spec.upper,
            )
        )  # fmt: skip
    identified = with_identified(model, estimates, "identified from recordings by a particle swarm")
    return Identified(
        Message("particle swarm, {count} simulations", count=found.simulations), identified, tuple(estimates)
    )
