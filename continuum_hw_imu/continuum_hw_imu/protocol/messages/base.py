"""What all messages have: a type's number, and a payload that they are written to and read from."""

from __future__ import annotations

from abc import abstractmethod
from enum import IntEnum
from typing import ClassVar, Protocol, Self

from continuum.errors import ContinuumError, InvalidValueError


class PayloadFault(ContinuumError):
    """Bytes that are no payload of the type. The decoder counts it; it goes no further."""


class Message(Protocol):
    """One type of message. Frozen dataclasses, equal when their contents are."""

    TYPE: ClassVar[int]

    @abstractmethod
    def encode(self) -> bytes:
        """The payload.

        Raises:
            InvalidValueError: a value that its field on the line cannot hold.
        """
        ...

    @classmethod
    @abstractmethod
    def decode(cls, payload: bytes) -> Self:
        """The message of a payload.

        Raises:
            PayloadFault: it is none of this type.
        """
        ...


def of_size(payload: bytes, size: int) -> bytes:
    """``payload``, which must be ``size`` bytes long.

    Raises:
        PayloadFault: it is not.
    """
    if len(payload) != size:
        raise PayloadFault(f"{len(payload)} bytes; allowed: {size}")
    return payload


def member[E: IntEnum](kind: type[E], number: int) -> E:
    """The member of an enumeration with this number.

    Raises:
        PayloadFault: it has none.
    """
    try:
        return kind(number)
    except ValueError:
        raise PayloadFault(f"{kind.__name__} {number}; unknown") from None


def in_steps(name: str, value: float, step: float, most: int, least: int = 0, unit: str = "") -> int:
    """``value`` as a whole number of steps, rounded.

    Raises:
        InvalidValueError: not finite, or fewer than ``least`` or more than ``most`` of them.
    """
    if not least - 0.5 <= value / step <= most + 0.5:  # false of NaN, too
        raise InvalidValueError(name, value, f"{least * step:g} to {most * step:g} {unit}".rstrip())
    return min(max(round(value / step), least), most)


def counted(name: str, number: int, most: int, least: int = 0) -> int:
    """``number``, which must be in a range.

    Raises:
        InvalidValueError: it is not.
    """
    if not least <= number <= most:
        raise InvalidValueError(name, number, f"{least} to {most}")
    return number
