"""Torques of the joints' drives over time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.model import InputKind


@dataclass(frozen=True)
class JointTorques(InputSignal):
    """Torque of each joint's drive, positive towards positive angles, (rows, n_joints) [N m]."""

    kind: ClassVar[InputKind] = InputKind.JOINT_TORQUES
    allowed: ClassVar[str] = "finite [N m], one for each joint"


def no_torques(n_joints: int) -> JointTorques:
    """Return zero torques at all times."""
    return JointTorques(np.zeros(1), np.zeros((1, n_joints)))
