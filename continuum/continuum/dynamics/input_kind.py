"""What drives an arm: its cables, or torques at its joints."""

from __future__ import annotations

from enum import Enum


class InputKind(Enum):
    """By the names that model files use."""

    CABLES = "cables"
    JOINT_TORQUES = "joint_torques"

    @property
    def in_words(self) -> str:
        """As messages name it."""
        return {"cables": "tensions of cables", "joint_torques": "joint torques"}[self.value]
