"""A tension guard with its clock and a record of its set points, for tests."""

import numpy as np

from continuum_hw_imu.protocol.messages import ReceiverLimits, Result
from continuum_hw_imu.receiver.safety_guard import SafetyGuard

TICK = 5_000  # us
LIMITS = ReceiverLimits(max_tension=40.0, max_rate=400.0)
A, B = 11, 22


class Bench:
    """A guard, its clock, and the record of its set points. It begins 100 s after the device's start."""

    def __init__(self, start: int = 100_000_000) -> None:
        self.guard = SafetyGuard(LIMITS, 2)
        self.now = start
        self.sequence = 0
        self.record = [self.guard.set_points]

    def run(
        self, seconds: float, *, pull: tuple[float, ...] | None = None, beat: bool = True, token: int = A
    ) -> Result:
        """Let time pass; the last answer."""
        result = Result.DONE
        for _ in range(round(seconds * 1e6 / TICK)):
            if pull is not None:
                result = self.pull(pull, token=token)
            elif beat:
                result = self.guard.heartbeat(token, self.now)
            self.tick()
        return result

    def tick(self) -> None:
        interval = self.guard.move_on(self.now, TICK * 1e-6)
        np.testing.assert_array_equal(interval.before, self.record[-1])
        self.now += TICK
        self.record.append(self.guard.set_points)

    def pull(self, tensions: tuple[float, ...], token: int = A, age: int = 0, sequence: int | None = None) -> Result:
        self.sequence = (self.sequence + 1) % (1 << 16) if sequence is None else sequence
        return self.guard.set_tension(token, self.sequence, (self.now - age) % (1 << 32), tensions, self.now)

    def reset_stop(self, token: int = A, age: int = 0) -> Result:
        return self.guard.reset_stop(token, (self.now - age) % (1 << 32), self.now)

    def seconds_to_slack(self) -> float:
        """How long from now on until no cable pulls, with nobody there."""
        start = self.now
        while self.guard.set_points.any():
            self.tick()
            assert self.now - start < 10_000_000, "never slack"
        return (self.now - start) * 1e-6
