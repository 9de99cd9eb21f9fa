"""A torque of any form at each joint: the hypothesis that something unknown is missing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.estimation.columns import Scene


@dataclass(frozen=True)
class FreeForm:
    """Bumps over each joint's angle, dry friction over its angle, and dry friction over its rate.

    Attributes:
        centers: of the bumps over the angle and of those of friction, (n, bumps) each [rad].
        widths: (n,) each [rad].
        rates: of the friction over the rate [rad/s].
    """

    centers: tuple[Array, Array]
    widths: tuple[Array, Array]
    rates: tuple[float, ...]

    @property
    def per_joint(self) -> int:
        """Columns of a joint."""
        return int(self.centers[0].shape[1] + self.centers[1].shape[1]) + len(self.rates)

    @property
    def width(self) -> int:
        return len(self.centers[0]) * self.per_joint

    def torque(self, scene: Scene) -> Array | None:
        q, w = scene.along.motion[:, 0], scene.along.motion[:, 1]
        sign = np.repeat(scene.sign, np.diff(scene.run.first), axis=0)
        n = q.shape[1]
        out = np.zeros((len(q), n, n, self.per_joint))
        for j in range(n):
            bumps = np.exp(-0.5 * ((q[:, j, None] - self.centers[0][j]) / self.widths[0][j]) ** 2)
            rubbing = np.exp(-0.5 * ((q[:, j, None] - self.centers[1][j]) / self.widths[1][j]) ** 2)
            slow = np.stack([np.exp(-((w[:, j] / rate) ** 2)) for rate in self.rates], axis=1)
            parts = [bumps * (sign[:, j, None] != 0), -sign[:, j, None] * rubbing, -sign[:, j, None] * slow]
            out[:, j, j] = np.hstack(parts)
        return out.reshape(len(q), n, -1)

    def reading(self, scene: Scene) -> Array | None:  # noqa: ARG002
        return None
