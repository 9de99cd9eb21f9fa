"""Bytes of every generator through the parsers of host and device, and the safety rules of the device."""

from __future__ import annotations

import tracemalloc
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from continuum_hw_imu.protocol.decoder import Decoder
from continuum_hw_imu.protocol.messages import Hello, ReceiverLimits, SensorPlace
from continuum_hw_imu.receiver.bench_controller import BenchController
from tools.benchmarks.fuzzing.line import BLOCK_TIME, Block, content_of

LIMITS = ReceiverLimits()
_CUTS = 8
HELLO = Hello(1, "fuzzed", 60.0, (SensorPlace(1, "a"),), 2, LIMITS)


@dataclass
class Tally:
    """Result for the bytes of one generator.

    Attributes:
        way: name of the generator.
        size: number of bytes.
        accepted: number of frames that a parser accepted.
        never_sent: number of accepted frames that were not sent.
        refused: number of refused stretches by kind, for both parsers.
        waiting: largest number of bytes that a parser stored.
        memory: peak memory above that at the start [bytes].
        largest_tension: largest tension that the device's rules let through [N].
    """

    way: str
    size: int = 0
    accepted: int = 0
    never_sent: int = 0
    refused: Counter[str] = field(default_factory=Counter)
    waiting: int = 0
    memory: int = 0
    largest_tension: float = 0.0


def run(way: str, blocks: Iterator[Block], size: int) -> Tally:
    """Feed blocks until ``size`` bytes are reached; exceptions of a parser propagate."""
    tally = Tally(way)
    host, device = Decoder.of_host(), BenchController(HELLO)
    witness = Decoder.of_device()  # receives the same bytes as the device's decoder, and returns the frames
    cuts = np.random.default_rng(2)
    recent: list[frozenset[bytes]] = []
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    try:
        now = 0
        while tally.size < size:
            block = next(blocks)
            recent = [*recent[-1:], block.sent]  # a frame may end in the next block
            tally.size += len(block.data)
            for piece in _cut(block.data, cuts):
                now += BLOCK_TIME // (_CUTS + 1)
                frames = [*host.feed(piece), *witness.feed(piece)]
                tally.never_sent += sum(not any(content_of(f) in sent for sent in recent) for f in frames)
                device.hear(piece, now)
                device.move_on(now, BLOCK_TIME / (_CUTS + 1) * 1e-6)
                tally.waiting = max(tally.waiting, host.waiting, device.decoder.waiting)
                tally.largest_tension = max(tally.largest_tension, float(device.guard.set_points.max()))
        tally.memory = tracemalloc.get_traced_memory()[1] - before
    finally:
        tracemalloc.stop()
    tally.accepted = host.good + device.decoder.good
    tally.refused = host.errors + device.decoder.errors
    return tally


def _cut(data: bytes, random: np.random.Generator) -> list[bytes]:
    """Split data into pieces as a port would."""
    places = [0, *sorted(random.integers(0, len(data) + 1, _CUTS).tolist()), len(data)]
    return [data[a:b] for a, b in pairwise(places)]
