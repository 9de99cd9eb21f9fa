"""Tensions of the cables: set points in force and measured values, sent with every sample of the sensors.

set point of each cable u16 [0.01 N] | measured tension of each cable i16 [0.01 N]
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from continuum_hw_imu.protocol.messages import forces
from continuum_hw_imu.protocol.messages.base import PayloadFault, counted

_CABLE = 4


@dataclass(frozen=True)
class TensionFrame:
    """Tensions at the frame's time.

    Attributes:
        set_points: current set points of the actuators, after limits and ramps, (n_cables,) [N].
        measured: readings of the load cells, (n_cables,) [N]; None where there is no measurement.
    """

    TYPE: ClassVar[int] = 0x03

    set_points: tuple[float, ...]
    measured: tuple[float | None, ...]

    def encode(self) -> bytes:
        n = counted("number of cables", len(self.set_points), forces.MOST_CABLES, 1)
        counted("number of measured tensions", len(self.measured), n, n)
        return forces.command_bytes(self.set_points) + forces.measured_bytes(self.measured)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        cables, rest = divmod(len(payload), _CABLE)
        if rest or not 1 <= cables <= forces.MOST_CABLES:
            raise PayloadFault(f"{len(payload)} bytes; allowed: 4 for each of 1 to {forces.MOST_CABLES} cables")
        middle = len(payload) // 2
        return cls(forces.commands(payload[:middle]), forces.measured(payload[middle:]))
