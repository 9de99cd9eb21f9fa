"""Tensions on the line: steps of 0.01 N in 16 bits, so that every command is finite."""

from __future__ import annotations

import struct
from collections.abc import Sequence

from continuum_hw_imu.protocol.messages.base import PayloadFault, in_steps

STEPS_IN_A_NEWTON = 100

STEP = 1 / STEPS_IN_A_NEWTON
"""[N]"""

LARGEST = 0x7FFF
"""Steps: 327.67 N."""

MOST_CABLES = 8

NONE_MEASURED = -0x8000
"""Value for a missing measured tension."""


def command_bytes(tensions: Sequence[float]) -> bytes:
    """Encode set points [N], none negative, as u16 each.

    Raises:
        InvalidValueError: a set point is negative, too large or not finite.
    """
    steps = [in_steps("tension", value, STEP, LARGEST, unit="N") for value in tensions]
    return struct.pack(f"<{len(steps)}H", *steps)


def commands(data: bytes) -> tuple[float, ...]:
    """Decode set points [N].

    Raises:
        PayloadFault: a set point exceeds the largest allowed one.
    """
    steps = struct.unpack(f"<{len(data) // 2}H", data)
    if max(steps) > LARGEST:
        raise PayloadFault(f"a set point of {max(steps)} steps; allowed: {LARGEST}")
    return tuple(step / STEPS_IN_A_NEWTON for step in steps)


def measured_bytes(tensions: Sequence[float | None]) -> bytes:
    """Encode measured tensions [N] as i16 each, None where none was measured; clip them to the range."""
    steps = [NONE_MEASURED if value is None else round(min(max(value / STEP, -LARGEST), LARGEST)) for value in tensions]
    return struct.pack(f"<{len(steps)}h", *steps)


def measured(data: bytes) -> tuple[float | None, ...]:
    """Decode measured tensions [N], None where none was measured."""
    return tuple(
        None if steps == NONE_MEASURED else steps / STEPS_IN_A_NEWTON
        for steps in struct.unpack(f"<{len(data) // 2}h", data)
    )
