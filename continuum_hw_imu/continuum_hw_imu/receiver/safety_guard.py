"""The safety rules of the bench: who may pull, how much, how fast, and when the cables are released.

As in the simulated arm, `TensionLimiter` determines how tensions follow the set points. This module decides which
requests are accepted:

- There is one commander at a time: the first to claim while there is no commander and all cables are slack.
- A set point contains the time of its decision by this clock. It is refused if that is too long ago, before the claim,
  or before the last stop, or if a later set point has arrived earlier.
- The claim ends when the commander is silent, when the link is lost, or when it is given back.
- A stop needs no claim, and is latched.

Times [us] are those of the device's clock, unwrapped.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.live.stepper import Interval
from continuum.dynamics.live.tension_limit import TensionLimiter, TensionLimits
from continuum_hw_imu.protocol.device_time import MICROSECONDS, signed_difference
from continuum_hw_imu.protocol.frame import WRAP_SEQUENCE, WRAP_TIME
from continuum_hw_imu.protocol.messages import Cause, GuardState, ReceiverLimits, Result


@dataclass
class _Claim:
    """Claim of the commander.

    Attributes:
        token: token of the commander.
        alive: time of its last message [us].
        sequence: sequence number of its last accepted set point; None before the first.
    """

    token: int
    alive: int
    sequence: int | None = None


class SafetyGuard:
    """Safety guard, initially slack and unclaimed.

    Args:
        limits: limits that the guard enforces.
        n_cables: number of cables.

    Attributes:
        cause: cause of the last release of the cables.
        stopped: whether a stop is latched.
    """

    def __init__(self, limits: ReceiverLimits, n_cables: int) -> None:
        self.limits = limits
        self._n_cables = n_cables
        bounds = TensionLimits(limits.max_tension, limits.max_rate, limits.command_timeout, limits.slack_time)
        self._limiter = TensionLimiter(bounds, n_cables)
        self._claim: _Claim | None = None
        self._floor = 0  # earlier decisions are refused [us]
        self.cause = Cause.START
        self.stopped = False

    @property
    def set_points(self) -> Array:
        """Current set points of the actuators, (n_cables,) [N]."""
        return self._limiter.tension

    @property
    def claimed(self) -> bool:
        """Whether there is a commander."""
        return self._claim is not None

    @property
    def state(self) -> GuardState:
        """State as defined by the protocol."""
        if self.stopped:
            return GuardState.STOPPED
        if not self._limiter.tight:
            return GuardState.SLACK
        return GuardState.LETTING_GO if self._limiter.abandoned else GuardState.FOLLOWING

    @property
    def abandoned(self) -> bool:
        """Whether tight cables were released and no set point has arrived since."""
        return self._limiter.abandoned

    def claim(self, token: int, now: int) -> Result:
        """Make the sender the commander."""
        if self._claim is not None and self._claim.token != token:
            return Result.BUSY
        if self._limiter.tight:
            if self._claim is not None:
                self._claim.alive = now
                self._let_go(Cause.CLAIMED_AGAIN)
            return Result.NOT_SLACK
        if self._claim is not None and self._claim.sequence is None:
            self._claim.alive = now  # a repeated request: decisions since the first one remain valid
        else:
            self._claim, self._floor = _Claim(token, now), now
        return Result.DONE

    def release(self, token: int, now: int) -> Result:
        """End the sender's claim and release the cables."""
        if not self._hears_commander(token, now):
            return Result.NOT_COMMANDER
        self._end_claim(Cause.RELEASED)
        return Result.DONE

    def heartbeat(self, token: int, now: int) -> Result:
        """Record a sign of life of the sender."""
        return Result.DONE if self._hears_commander(token, now) else Result.NOT_COMMANDER

    def set_tension(self, token: int, sequence: int, as_of: int, wanted: Sequence[float], now: int) -> Result:
        """Accept or refuse set points [N] of the frame ``sequence``, decided at ``as_of`` [us] modulo 2^32."""
        claim = self._hears_commander(token, now)
        if claim is None:
            return Result.NOT_COMMANDER
        tensions = np.asarray(wanted, dtype=float)
        if tensions.shape != (self._n_cables,) or not np.all(np.isfinite(tensions)) or np.any(tensions < 0):
            return Result.REFUSED
        if self.stopped:
            return Result.STOPPED
        if claim.sequence is not None and not 0 < (sequence - claim.sequence) % WRAP_SEQUENCE < WRAP_SEQUENCE // 2:
            return Result.OUT_OF_ORDER
        decided = now + signed_difference(as_of, now % WRAP_TIME)
        if not self._counts(decided, now):
            return Result.STALE
        claim.sequence = sequence
        self._limiter.command(tensions, decided / MICROSECONDS)
        return Result.LIMITED if np.any(tensions > self.limits.max_tension) else Result.DONE

    def let_go(self, token: int, now: int) -> Result:
        """Make the cables slack at once; later set points pull again."""
        if not self._hears_commander(token, now):
            return Result.NOT_COMMANDER
        self._drop(Cause.RELEASED, now)
        return Result.DONE

    def stop(self, now: int) -> Result:
        """Make the cables slack at once, and refuse set points until a reset."""
        self._drop(Cause.STOP, now)
        self.stopped = True
        return Result.DONE

    def reset_stop(self, token: int, as_of: int, now: int) -> Result:
        """Accept set points that are decided from now on; refuse a reset that was decided before the stop."""
        if not self._hears_commander(token, now):
            return Result.NOT_COMMANDER
        if not self._counts(now + signed_difference(as_of, now % WRAP_TIME), now):
            return Result.STALE
        self.stopped, self._floor = False, now
        return Result.DONE

    def lose_link(self) -> None:
        """React to the loss of the link."""
        self._end_claim(Cause.LINK_LOST)

    def move_on(self, now: int, duration: float) -> Interval:
        """Advance the set points by a ``duration`` [s] from ``now`` [us], and return their interval."""
        claim = self._claim
        if claim is not None and now - claim.alive > self.limits.heartbeat_timeout * MICROSECONDS:
            self._end_claim(Cause.HEARTBEATS_STOPPED)
        before = self._limiter.abandoned
        interval = self._limiter.move_on(now / MICROSECONDS, duration)
        if self._limiter.abandoned and not before:
            self.cause = Cause.COMMANDS_STOPPED
        return interval

    def _hears_commander(self, token: int, now: int) -> _Claim | None:
        """Return the claim if it has this token, and record the sign of life."""
        if self._claim is None or self._claim.token != token:
            return None
        self._claim.alive = now
        return self._claim

    def _counts(self, decided: int, now: int) -> bool:
        """Return whether a decision time [us] is recent enough and not before the claim or the last stop."""
        return max(self._floor, now - self.limits.command_timeout * MICROSECONDS) <= decided <= now

    def _end_claim(self, cause: Cause) -> None:
        if self._claim is not None:
            self._claim = None
            self._let_go(cause)

    def _let_go(self, cause: Cause) -> None:
        if not self.stopped:
            self.cause = cause
        self._limiter.abandon()

    def _drop(self, cause: Cause, now: int) -> None:
        self._limiter.release()
        self.cause, self._floor = cause, now
