"""Bytes for the parsers: random bytes, or damaged valid frames. The same generator gives the same bytes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from continuum_hw_imu.emulator.line_faults import FaultyLine, LineFault, LineFaultKind
from continuum_hw_imu.protocol import checksum, cobs
from continuum_hw_imu.protocol.frame import HEADER, LONGEST_BODY, VERSION, WRAP_SEQUENCE, WRAP_TIME, Frame
from continuum_hw_imu.protocol.messages import (
    OF_DEVICE,
    OF_HOST,
    Claim,
    Heartbeat,
    LetGo,
    Message,
    Release,
    ResetStop,
    SetTension,
    Stop,
)

TYPES = tuple(kind.TYPE for kind in (*OF_DEVICE, *OF_HOST))
_BLOCK = 4096

BLOCK_TIME = 36_000
"""Time between two blocks by the device's clock [us]."""


@dataclass(frozen=True)
class Block:
    """A piece of the line.

    Attributes:
        data: bytes for the parsers.
        sent: bodies that were deliberately sealed with a right checksum, and may therefore be accepted.
    """

    data: bytes
    sent: frozenset[bytes] = frozenset()


def made_up(random: np.random.Generator) -> Iterator[Block]:
    """Yield uniformly random bytes."""
    while True:
        yield Block(random.bytes(_BLOCK))


def made_up_with_ends(random: np.random.Generator) -> Iterator[Block]:
    """Yield random bytes, split by zeros into stretches of the length of frames, and valid as COBS."""
    while True:
        stretches = [cobs.encoded(random.bytes(int(random.integers(1, LONGEST_BODY + 20)))) for _ in range(30)]
        yield Block(b"\0".join(stretches) + b"\0")


def sealed(random: np.random.Generator) -> Iterator[Block]:
    """Yield frames of any type and payload with a right checksum, which reach the decoding of messages."""
    while True:
        contents = [
            HEADER.pack(VERSION, int(random.choice(TYPES)), *map(int, random.integers(0, 1 << 16, 2)))
            + random.bytes(int(random.choice([random.integers(0, 30), random.integers(0, 243)])))
            for _ in range(40)
        ]
        data = b"".join(b"\0" + cobs.encoded(checksum.sealed(content)) + b"\0" for content in contents)
        yield Block(data, frozenset(contents))


def mutated(random: np.random.Generator) -> Iterator[Block]:
    """Yield valid frames of every type, some of them lost, damaged, truncated, repeated, or after noise."""
    line = FaultyLine(random)
    for kind, share in (("lose", 0.05), ("damage", 0.4), ("repeat", 0.1), ("noise", 0.2)):
        line.add(LineFault(LineFaultKind(kind), share, np.inf, size=300))
    contents = sound_contents(random)
    while True:
        chosen = [next(contents) for _ in range(60)]
        pieces = [b"\0" + cobs.encoded(checksum.sealed(content)) + b"\0" for content in chosen]
        data = b"".join(part for piece in pieces for _, part in line.passed(piece, 0.0))
        yield Block(data, frozenset(chosen))


def restless(random: np.random.Generator) -> Iterator[Block]:
    """Yield damaged requests of two competing hosts, for the safety rules."""
    line = FaultyLine(random)
    for kind, share in (("lose", 0.05), ("damage", 0.05), ("repeat", 0.1)):
        line.add(LineFault(LineFaultKind(kind), share, np.inf))
    sequence, begin = 0, 0
    while True:
        begin += BLOCK_TIME
        frames = []
        for _ in range(40):
            sequence += int(random.choice([1, 1, 1, 1, 2, -1]))
            frames.append(Frame(sequence % WRAP_SEQUENCE, 0, _request(random, begin)))
        pieces = [frame.encode() for frame in frames]
        data = b"".join(part for piece in pieces for _, part in line.passed(piece, 0.0))
        yield Block(data, frozenset(content_of(frame) for frame in frames))


WAYS: dict[str, Callable[[np.random.Generator], Iterator[Block]]] = {
    "bytes at random": made_up,
    "stretches at random, sound as COBS": made_up_with_ends,
    "any payload behind a right check": sealed,
    "sound frames, hurt": mutated,
    "requests of two restless hosts, hurt": restless,
}


def content_of(frame: Frame) -> bytes:
    """Return the body, without checksum, from which a frame was read."""
    body = cobs.decoded(frame.encode()[1:-1])
    return b"" if body is None else body[: -checksum.SIZE]


def _request(random: np.random.Generator, now: int) -> Message:
    """One request, decided about now [us]."""
    token, as_of = int(random.integers(1, 3)), (now + int(random.integers(-300_000, BLOCK_TIME))) % WRAP_TIME
    tensions = tuple((random.integers(0, 32768, int(random.choice([2, 2, 2, 1, 3]))) / 100).tolist())
    chance = random.random()
    if chance < 0.8:
        return SetTension(token, as_of, tensions)
    if chance > 0.998:
        return Stop()
    if chance > 0.995:
        return LetGo(token) if chance > 0.996 else Release(token)
    return ResetStop(token, as_of) if chance > 0.95 else Heartbeat(token) if chance > 0.85 else Claim(token)


def sound_contents(random: np.random.Generator) -> Iterator[bytes]:
    """Yield bodies, without checksums, of random payloads that can be decoded."""
    kinds = (*OF_DEVICE, *OF_HOST)
    sizes = {kind: _sizes(kind.TYPE) for kind in kinds}
    while True:
        kind = kinds[int(random.integers(len(kinds)))]
        payload = random.bytes(int(random.choice(sizes[kind])))
        yield HEADER.pack(VERSION, kind.TYPE, *map(int, random.integers(0, 1 << 16, 2))) + payload


def _sizes(number: int) -> list[int]:
    """Return the possible lengths of payloads of a type."""
    return {0x01: [30, 89], 0x02: [67, 132], 0x03: [8, 16], 0x04: [4], 0x05: [14], 0x06: [2]}.get(
        number, {0x81: [0], 0x85: [12, 16], 0x86: [0], 0x87: [8]}.get(number, [4])
    )
