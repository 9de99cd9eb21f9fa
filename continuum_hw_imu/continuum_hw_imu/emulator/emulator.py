"""The emulated bench in real time on its port: input and output, orders, and the record of the true motion.

The main loop calls `hear`, then `step` with the time of a clock, repeatedly: at `wake_at` at the latest, or when bytes
have arrived.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.dynamics.planar.cable_lengths import SIDES
from continuum_hw_imu.emulator.bench import Bench
from continuum_hw_imu.emulator.device_clock import DeviceClock
from continuum_hw_imu.emulator.line_faults import FaultyLine, pieces_of
from continuum_hw_imu.emulator.line_queue import LineQueue
from continuum_hw_imu.emulator.pseudo_port import PseudoPort
from continuum_hw_imu.emulator.sent_file import SentFile
from continuum_hw_imu.emulator.truth_file import TruthFile
from continuum_hw_imu.protocol.device_time import MICROSECONDS
from continuum_hw_imu.protocol.frame import FrameWriter
from continuum_hw_imu.protocol.messages import FaultCode, Message

_LATE = 0.05
"""Delay behind the clock above which the controller reports an overrun [s]."""

_GIVEN_UP = 2.0
"""Delay above which time is skipped, for example after the machine was suspended [s]."""

_LONGEST_STEP = 0.25
"""Longest simulated time in one call [s]."""


@dataclass(frozen=True)
class EmulatorSettings:
    """Settings of the emulator besides those of the bench.

    Attributes:
        link: path of a symbolic link to the port.
        truth: file for the true motion.
        sent: file for the send times of frames.
        baud: speed of the line [bit/s]; 0 for no transmission time.
        clock_start: reading of the controller's clock at the start [us].
        sees_hang_up: whether the controller detects that the host closes the port, as by DTR; otherwise it has only its
            time-outs.
        seed: seed of the faults of the line.
    """

    link: Path | None = None
    truth: Path | None = None
    sent: Path | None = None
    baud: float = 0.0
    clock_start: int = 0
    sees_hang_up: bool = True
    seed: int = 0


class Emulator:
    """Emulator that starts at the time ``now``.

    Args:
        bench: the bench, at its start.
        settings: all other settings.
        now: real time [s] of a monotonic clock, as all times here.

    Attributes:
        bench, port, clock, up, down: parts of the emulator; ``up`` is the line's direction to the host.
        skipped: time that was not simulated because the machine was too busy [s].

    Raises:
        FileError: a file or link cannot be created.
    """

    def __init__(self, bench: Bench, settings: EmulatorSettings, now: float) -> None:
        self.bench, self._settings = bench, settings
        random = np.random.default_rng(settings.seed)
        self.up, self.down = FaultyLine(random), FaultyLine(random)
        self._outgoing, self._incoming = LineQueue(settings.baud), LineQueue(settings.baud)
        self.port = PseudoPort(settings.link)
        self._truth = TruthFile(settings.truth, bench.n_joints, len(SIDES)) if settings.truth else None
        self._sent = SentFile(settings.sent) if settings.sent else None
        self.began = now
        self.skipped = 0.0
        self.largest_set_point = 0.0
        self._open = False
        self._received = b""
        self.clock = DeviceClock(now, settings.clock_start)
        self._begin(settings.clock_start)

    def close(self) -> None:
        """Remove port and link, and close the records."""
        self.port.unplug()
        if self._truth is not None:
            self._truth.close()
        if self._sent is not None:
            self._sent.close()

    @property
    def wake_at(self) -> float:
        """Return the time at which the next action is due [s]."""
        tick = self.clock.real(self._tick_time(self._ticks + 1))
        return min(tick, *(when for when in (self._outgoing.next, self._incoming.next, np.inf) if when is not None))

    def hear(self) -> None:
        """Read the bytes that have arrived; before the clock is read, so that none is answered before it was sent."""
        self._received += self.port.read()

    def step(self, now: float) -> None:
        """Carry out the actions that are due, and answer what was received."""
        self._watch_port(now)
        received, self._received = self._received, b""
        for piece in pieces_of(received):
            for delay, part in self.down.passed(piece, now):
                self._incoming.put(now, part, delay)
        for data in self._incoming.due(now):
            self._send(self.bench.hear(data, self.clock.at(now)), self.clock.at(now), now)
        self._catch_up(now)
        for data in self._outgoing.due(now):
            if self.port.open:
                self.port.write(data)
                if self._sent is not None:
                    self._sent.note(data)
        self.port.flush()

    def unplug(self) -> None:
        """Unplug the port; the controller continues to run."""
        self.port.unplug()
        self._received = b""
        self._outgoing.clear()
        self._incoming.clear()

    def reboot(self, now: float) -> None:
        """Restart the controller, as after a power failure."""
        self.bench.boot()
        self._outgoing.clear()
        self._incoming.clear()
        self.clock = DeviceClock(now, 0, self.clock.drift)
        self._begin(0)
        if self._open:
            self._send(self.bench.controller.connect(), 0, now)

    def _begin(self, shows: int) -> None:
        """Start counting frames and ticks at the clock reading ``shows`` [us]."""
        self._writer = FrameWriter()
        self._first, self._ticks = shows, 0

    def _tick_time(self, tick: int) -> int:
        """Return the reading of the device's clock at a tick [us]."""
        return self._first + round(tick * MICROSECONDS / self.bench.tick_rate)

    def _watch_port(self, now: float) -> None:
        opened = self.port.open
        if opened == self._open:
            return
        self._open = opened
        if opened:
            self._send(self.bench.controller.connect(), self.clock.at(now), now)
        else:
            self.port.forget()
            if self._settings.sees_hang_up or not self.port.plugged:
                self.bench.controller.disconnect()

    def _catch_up(self, now: float) -> None:
        """Simulate the ticks that are due."""
        behind = now - self.clock.real(self._tick_time(self._ticks + 1))
        self.bench.controller.faults.put(behind > _LATE, FaultCode.OVERRUN)
        if behind > _GIVEN_UP:
            self.skipped += behind
            self._ticks += int(behind * self.bench.tick_rate)
        end = min(now, self.clock.real(self._tick_time(self._ticks)) + _LONGEST_STEP)
        while (reached := self.clock.real(self._tick_time(self._ticks + 1))) <= end:
            self._tick(reached, now)

    def _tick(self, reached: float, now: float) -> None:
        begin, end = self._tick_time(self._ticks), self._tick_time(self._ticks + 1)
        messages = self.bench.tick(begin, reached - self.clock.real(begin), reached)
        self._ticks += 1
        self.largest_set_point = max(self.largest_set_point, float(self.bench.controller.guard.set_points.max()))
        if messages and self._truth is not None:
            self._truth.write(end, reached, self.bench)
        self._send([*messages, *self.bench.controller.news(end)], end, now)

    def _send(self, messages: list[Message], time: int, now: float) -> None:
        """Put frames with a device time on the line if a host is connected."""
        if not self._open:
            return
        for message in messages:
            for delay, piece in self.up.passed(self._writer.write(message, time), now):
                self._outgoing.put(now, piece, delay)
