"""Messages of the host. An `Ack` answers all of them except `HelloRequest` and a valid `Heartbeat`.

A token [u32] identifies a commander, which draws a random one for every connection. Only one commands at a time.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import ClassVar, Self

from continuum_hw_imu.protocol.messages import forces
from continuum_hw_imu.protocol.messages.base import PayloadFault, counted, of_size

_TOKEN = struct.Struct("<I")
_COMMAND = struct.Struct("<II")


@dataclass(frozen=True)
class _Empty:
    """A request without a payload."""

    def encode(self) -> bytes:
        return b""

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        of_size(payload, 0)
        return cls()


@dataclass(frozen=True)
class _WithToken:
    """A request that contains only the token of its sender.

    Attributes:
        token: token of the sender.
    """

    token: int

    def encode(self) -> bytes:
        return _TOKEN.pack(counted("token", self.token, 0xFFFFFFFF))

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        return cls(*_TOKEN.unpack(of_size(payload, _TOKEN.size)))


class HelloRequest(_Empty):
    """Request the identification; answered by `Hello`."""

    TYPE: ClassVar[int] = 0x81


class Claim(_WithToken):
    """Become the commander; granted if there is none and the cables are slack.

    From the present commander it means that the commander has restarted: the cables are released first.
    """

    TYPE: ClassVar[int] = 0x82


class Release(_WithToken):
    """Give back the claim; the cables are released."""

    TYPE: ClassVar[int] = 0x83


class Heartbeat(_WithToken):
    """Sign of life of the commander, like all its other requests. Answered only if the token is wrong."""

    TYPE: ClassVar[int] = 0x84


@dataclass(frozen=True)
class SetTension:
    """Set points for all cables: token u32 | as of u32 [us] | set point of each cable u16 [0.01 N].

    Attributes:
        token: token of the commander.
        as_of: the device's clock [us] modulo 2^32 when the command was decided, as far as the host knows it: the time
            of the newest frame that had arrived by then, or an earlier instant. From it the device determines the
            command's age with its clock alone, and refuses commands from before the claim or the last stop.
        tensions: (n_cables,) [N], none negative.
    """

    TYPE: ClassVar[int] = 0x85

    token: int
    as_of: int
    tensions: tuple[float, ...]

    def encode(self) -> bytes:
        counted("number of cables", len(self.tensions), forces.MOST_CABLES, 1)
        head = _COMMAND.pack(counted("token", self.token, 0xFFFFFFFF), counted("as of", self.as_of, 0xFFFFFFFF))
        return head + forces.command_bytes(self.tensions)

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        cables, rest = divmod(len(payload) - _COMMAND.size, 2)
        if rest or not 1 <= cables <= forces.MOST_CABLES:
            raise PayloadFault(f"{len(payload)} bytes; allowed: 8 and 2 for each of 1 to {forces.MOST_CABLES} cables")
        token, as_of = _COMMAND.unpack_from(payload)
        return cls(token, as_of, forces.commands(payload[_COMMAND.size :]))


class Stop(_Empty):
    """Make all cables slack at once, until a reset; accepted from any sender."""

    TYPE: ClassVar[int] = 0x86


@dataclass(frozen=True)
class ResetStop:
    """End a stop, as the commander. Tension stays zero until a new `SetTension`.

    Attributes:
        token: token of the commander.
        as_of: as in `SetTension`, so that a reset does not end a later stop.
    """

    TYPE: ClassVar[int] = 0x87

    token: int
    as_of: int

    def encode(self) -> bytes:
        return _COMMAND.pack(counted("token", self.token, 0xFFFFFFFF), counted("as of", self.as_of, 0xFFFFFFFF))

    @classmethod
    def decode(cls, payload: bytes) -> Self:
        return cls(*_COMMAND.unpack(of_size(payload, _COMMAND.size)))


class LetGo(_WithToken):
    """Make all cables slack at once, as for a release test; later set points pull again."""

    TYPE: ClassVar[int] = 0x88
