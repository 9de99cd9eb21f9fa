"""All that the terms of Eq. 12 may look at: motion, cable tensions at the base, and the parameters that hold."""

from __future__ import annotations

from dataclasses import dataclass

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
    """

    motion: Motion
    u: Numbers
    p: Parameters
