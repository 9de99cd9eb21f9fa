"""Interface of all messages: the number of the type, and encoding to and decoding from a payload."""

from __future__ import annotations

from abc import abstractmethod
from enum import IntEnum
from typing import ClassVar, Protocol, Self

from continuum.errors import ContinuumError, InvalidValueError


class PayloadFault(ContinuumError):
    """Bytes are not a payload of the type. The decoder counts and handles this error."""


class Message(Protocol):
    """One type of message, a frozen dataclass with equality by content."""

    TYPE: ClassVar[int]

    @abstractmethod
    def encode(self) -> bytes:
        """Return the payload.

        Raises:
            InvalidValueError: a value exceeds its field on the line.
        """
        ...

    @classmethod
    @abstractmethod
    def decode(cls, payload: bytes) -> Self:
        """Return the message in a payload.

        Raises:
            PayloadFault: it is not a payload of this type.
        """
        ...


def of_size(payload: bytes, size: int) -> bytes:
    """Return ``payload`` after checking that it has ``size`` bytes.

    Raises:
        PayloadFault: it has another size.
    """
    if len(payload) != size:
        raise PayloadFault(f"{len(payload)} bytes; allowed: {size}")
    return payload


def member[E: IntEnum](kind: type[E], number: int) -> E:
    """Return the member of an enumeration with this number.

    Raises:
        PayloadFault: no member has this number.
    """
    try:
        return kind(number)
    except ValueError:
        raise PayloadFault(f"{kind.__name__} {number}; unknown") from None


def in_steps(name: str, value: float, step: float, most: int, least: int = 0, unit: str = "") -> int:
    """Return ``value`` as a whole number of steps, rounded.

    Raises:
        InvalidValueError: the value is not finite, or the number is not from ``least`` to ``most``.
    """
    if not least - 0.5 <= value / step <= most + 0.5:  # also refuses NaN
        raise InvalidValueError(name, value, f"{least * step:g} to {most * step:g} {unit}".rstrip())
    return min(max(round(value / step), least), most)


def counted(name: str, number: int, most: int, least: int = 0) -> int:
    """Return ``number`` after checking its range.

    Raises:
        InvalidValueError: it is out of range.
    """
    if not least <= number <= most:
        raise InvalidValueError(name, number, f"{least} to {most}")
    return number
