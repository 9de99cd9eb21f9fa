"""What is wrong at the device now, and what began to be wrong since it was last asked."""

from __future__ import annotations

from continuum_hw_imu.protocol.messages import Fault, FaultCode


class FaultBoard:
    """Nothing is wrong at first."""

    def __init__(self) -> None:
        self._holding: set[Fault] = set()
        self._unreported: list[Fault] = []

    def put(self, holds: bool, code: FaultCode, subject: int = 0) -> None:
        """Say whether a fault holds."""
        fault = Fault(code, subject)
        if not holds:
            self._holding.discard(fault)
        elif fault not in self._holding:
            self._holding.add(fault)
            self._unreported.append(fault)

    @property
    def bits(self) -> int:
        """As in `Status.faults`."""
        return sum({1 << fault.code for fault in self._holding})

    def take_unreported(self) -> list[Fault]:
        """What began since the last call, oldest first."""
        unreported, self._unreported = self._unreported, []
        return unreported
