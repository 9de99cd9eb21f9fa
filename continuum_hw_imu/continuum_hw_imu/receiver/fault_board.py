"""Active faults of the device, and faults that started since the last query."""

from __future__ import annotations

from continuum_hw_imu.protocol.messages import Fault, FaultCode


class FaultBoard:
    """Board of faults, initially without any."""

    def __init__(self) -> None:
        self._holding: set[Fault] = set()
        self._unreported: list[Fault] = []

    def put(self, holds: bool, code: FaultCode, subject: int = 0) -> None:
        """Set whether a fault is active."""
        fault = Fault(code, subject)
        if not holds:
            self._holding.discard(fault)
        elif fault not in self._holding:
            self._holding.add(fault)
            self._unreported.append(fault)

    @property
    def bits(self) -> int:
        """Return the active faults as in `Status.faults`."""
        return sum({1 << fault.code for fault in self._holding})

    def take_unreported(self) -> list[Fault]:
        """Return the faults that started since the last call, oldest first."""
        unreported, self._unreported = self._unreported, []
        return unreported
