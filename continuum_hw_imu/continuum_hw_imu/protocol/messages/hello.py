"""Identification of the device: its sensors and their places, its cables, and the limits of its receiver.

boot u32 | sample rate u16 [0.01 Hz] | max tension u16 [0.01 N] | max rate u16 [0.1 N/s]
| command timeout, heartbeat timeout, slack time u16 [ms] | cables u8 | sensors u8
| firmware: length u8, text | per sensor: link u8, length u8, text
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import ClassVar, Self

from continuum.errors import InvalidValueError
from continuum_hw_imu.protocol.messages import forces
from continuum_hw_imu.protocol.messages.base import PayloadFault, counted, in_steps
from continuum_hw_imu.protocol.messages.imu import MOST_SENSORS

_FORM = struct.Struct("<I6H2B")
_U16 = 0xFFFF
LONGEST_FIRMWARE = 24
LONGEST_NAME = 12
"""Longest name of a sensor; a device address without colons fits."""

PRINTABLE = range(0x20, 0x7F)


@dataclass(frozen=True)
class ReceiverLimits:
    """Limits that the receiver enforces for all commands.

    Attributes:
        max_tension: largest tension of each cable [N].
        max_rate: largest rate of commanded changes [N/s].
        command_timeout: largest age at which a set point is accepted, and time for which it then holds [s].
        heartbeat_timeout: silence of the commander after which its claim ends [s].
        slack_time: time in which the tension of released cables falls to zero [s].
    """

    max_tension: float = 40.0
    max_rate: float = 200.0
    command_timeout: float = 0.5
    heartbeat_timeout: float = 0.25
    slack_time: float = 0.5

    @property
    def slack_after(self) -> float:
        """Longest time from the commander's last message to slack cables [s]."""
        return max(self.command_timeout, self.heartbeat_timeout) + self.slack_time


@dataclass(frozen=True)
class SensorPlace:
    """Place of a sensor.

    Attributes:
        link: number of its link, from 1 at the base; the joint of this number moves it relative to the previous link.
        name: printable ASCII.
    """

    link: int
    name: str


@dataclass(frozen=True)
class Hello:
    """Identification that is sent at the start, when the port is opened, and on request.

    Attributes:
        boot: random number of each start of the device, which also restarts its clock and counters.
        firmware: name and version.
        sample_rate: sample rate of the sensors [Hz].
        sensors: places of the sensors, in the order of the frames.
        n_cables: number of cables; the first one runs at phi = 0, the direction of positive bends.
        limits: limits of the receiver.
    """

    TYPE: ClassVar[int] = 0x01

    boot: int
    firmware: str
    sample_rate: float
    sensors: tuple[SensorPlace, ...]
    n_cables: int
    limits: ReceiverLimits

    def encode(self) -> bytes:
        limits = self.limits
        times = (limits.command_timeout, limits.heartbeat_timeout, limits.slack_time)
        coded = _FORM.pack(
            counted("boot", self.boot, 0xFFFFFFFF),
            in_steps("sample rate", self.sample_rate, 0.01, _U16, 1, "Hz"),
            in_steps("max tension", limits.max_tension, forces.STEP, forces.LARGEST, unit="N"),
            in_steps("max rate", limits.max_rate, 0.1, _U16, unit="N/s"),
            *(in_steps("time-out", time, 1e-3, _U16, unit="s") for time in times),
            counted("number of cables", self.n_cables, forces.MOST_CABLES, 1),
            counted("number of sensors", len(self.sensors), MOST_SENSORS, 1),
        )
        coded += _text_bytes("firmware", self.firmware, LONGEST_FIRMWARE)
        for sensor in self.sensors:
            link = counted("link", sensor.link, 0xFF, 1)
            coded += bytes([link]) + _text_bytes("name of sensor", sensor.name, LONGEST_NAME)
        return coded

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        if len(payload) < _FORM.size:
            raise PayloadFault(f"{len(payload)} bytes; allowed: at least {_FORM.size}")
        boot, rate, tension, change, command, heartbeat, slack, cables, count = _FORM.unpack_from(payload)
        if not (rate and 1 <= cables <= forces.MOST_CABLES and 1 <= count <= MOST_SENSORS):
            raise PayloadFault(f"sample rate {rate}, {cables} cables, {count} sensors")
        if tension > forces.LARGEST:
            raise PayloadFault(f"max tension of {tension} steps; allowed: {forces.LARGEST}")
        firmware, at = _text(payload, _FORM.size, LONGEST_FIRMWARE)
        sensors = []
        for _ in range(count):
            if at >= len(payload) or payload[at] == 0:
                raise PayloadFault("a sensor without a link")
            link = payload[at]
            name, at = _text(payload, at + 1, LONGEST_NAME)
            sensors.append(SensorPlace(link, name))
        if at != len(payload):
            raise PayloadFault(f"{len(payload) - at} bytes too many")
        limits = ReceiverLimits(
            tension / forces.STEPS_IN_A_NEWTON, change / 10, command / 1000, heartbeat / 1000, slack / 1000
        )
        return cls(boot, firmware, rate / 100, tuple(sensors), cables, limits)


def _text_bytes(name: str, text: str, longest: int) -> bytes:
    if len(text) > longest or any(ord(letter) not in PRINTABLE for letter in text):
        raise InvalidValueError(name, text, f"up to {longest} printable ASCII letters")
    return bytes([len(text)]) + text.encode("ascii")


def _text(payload: bytes, at: int, longest: int) -> tuple[str, int]:
    """Return the text at a position, and the position after it."""
    size = payload[at] if at < len(payload) else longest + 1
    data = payload[at + 1 : at + 1 + size]
    if size > longest or len(data) != size or any(letter not in PRINTABLE for letter in data):
        raise PayloadFault(f"no text of up to {longest} printable letters at byte {at}")
    return data.decode("ascii"), at + 1 + size
