"""Clearance between a spring and its joint: within +- gap of rest the spring does not act, beyond it by K (x -+ gap).

x is the joint's angle from rest. The corners at +- gap are rounded within 0.005 rad (0.3 degrees: what the sensors
still see): K (x - (r(x + gap) - r(x - gap)) / 2) with r(y) = sqrt(y^2 + width^2). A spring's leg of 1 mm in a hole of
1.3 mm at a radius of 10 mm has 0.015 rad each way; 0.03 rad take 0.037 N m of K = 1.24 N m/rad, its dry friction.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

from continuum.dynamics.effect import Effect, Own
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameter
from continuum.dynamics.planar.instant import Instant
from continuum.effects.parts.rounded import rounded_size

_CORNER = 5e-3  # rad


class Backlash(Effect):
    """A dead band of a joint's spring."""

    name = "backlash"
    parameters: ClassVar[Mapping[str, Parameter]] = {
        "gap": Parameter("delta", "rad", 0.0, 0.5, True, "clearance to each side of rest", 0.0, 0.03)
    }
    source = "Nordin and Gutman, Automatica 38, 2002, 1633-1649"
    in_words = "A joint has play: near straight its spring does not touch."
    looks_like = "Near rest the joint moves freely and small swings are slow, further out it follows the model's slope."
    experiment = "Move the resting joint by hand with a force gauge: within the play it meets friction only."

    def torque(self, now: Instant, own: Own, state: Numbers) -> Numbers:
        x, gap = now.motion.theta - now.p.rest_angle, own["gap"]
        return -now.p.stiffness * (rounded_size(x + gap, _CORNER) - rounded_size(x - gap, _CORNER)) / 2
