"""All that the terms of Eq. 12 may look at: motion, cable tensions, joint torques, and the parameters that hold."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.planar.motion import Motion


@dataclass(frozen=True)
class Instant:
    """One instant of the arm, as an equation sees it.

    Attributes:
        motion: of joints and links.
        u: tension of each cable at the base, (n_cables,) [N].
        p: parameters.
        drive: torque of the joints' drives, (n,) [N m], or (1,) where there are none.
    """

    motion: Motion
    u: Numbers
    p: Parameters
    drive: Numbers = field(default_factory=lambda: np.zeros(1))
