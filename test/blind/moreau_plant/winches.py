"""What lies between the tensions that rows hold and those that pull at the base plate."""

import numpy as np

from blind.moreau_plant.compiled import compiled
from blind.moreau_plant.mechanism import Mechanism
from blind.moreau_plant.state import State

WINCH_FRICTION = 12.0  # of the winch of an elastic cable [N s/m]
REELING = 0.3  # speed of a winch that takes up a sag [m/s]
REELED_ABOVE = 1.0  # command above which it does [N]
TAUT_WITHIN = 1e-3  # sag below which a cable begins to pull [m]


@compiled
def pulls(m: Mechanism, state: State, command: np.ndarray, length: np.ndarray, dt: float) -> np.ndarray:
    """Tensions at the base (2,) [N], in this order behind load cells, a lag, a sag and elastic cables.

    Args:
        m: with lag, sag and compliance.
        state: of lag, sag and winches; it goes on by a step.
        command: as rows hold it (2,) [N].
        length: of the cables now (2,) [m].
        dt: time step [s].
    """
    pulling = np.empty(2)
    for c in range(2):
        u = command[c] / m.shown[c]
        if m.lag > 0.0:
            before = state.lagging[c]
            state.lagging[c] = u + np.exp(-dt / m.lag) * (before - u)
            u = 0.5 * (before + state.lagging[c])
        if m.sag > 0.0:
            reeled = -REELING if u > REELED_ABOVE else REELING
            longer = length[c] - state.length[c]
            state.sagging[c] = min(max(state.sagging[c] + dt * reeled - longer, 0.0), m.sag)
            u *= max(0.0, 1 - state.sagging[c] / TAUT_WITHIN)
        if m.compliance > 0.0:
            shorter = state.straight[c] - length[c]
            rate = dt / WINCH_FRICTION  # the step of the winch is implicit; a slack cable is reeled in at once
            reeled = (state.reeled[c] + rate * (u + shorter / m.compliance)) / (1 + rate / m.compliance)
            state.reeled[c] = max(reeled, shorter)
            u = (state.reeled[c] - shorter) / m.compliance
        state.length[c] = length[c]
        pulling[c] = u
    return pulling
