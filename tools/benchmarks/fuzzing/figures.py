"""The record of `make fuzz`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from continuum_hw_imu.protocol.frame import LONGEST_CODED
from tools.benchmarks.fuzzing.campaign import LIMITS, Tally
from tools.benchmarks.record import Figure, Record, Table

_REFUSED = ("too long", "too short", "not COBS", "checksum", "other version", "unknown type", "payload")


def record_of(tallies: Sequence[Tally], guided: Mapping[str, int] | None) -> Record:
    """Return the record of all generators, and of the coverage-guided search if it ran."""
    size = sum(tally.size for tally in tallies) + (guided["size"] if guided else 0)
    waiting = max([*(tally.waiting for tally in tallies), guided["waiting"] if guided else 0])
    tension = max(tally.largest_tension for tally in tallies)
    what = f"{size / 1e6:.1f} million damaged and made-up bytes"
    never_sent, memory = sum(t.never_sent for t in tallies), max(t.memory for t in tallies) / 1024
    figures = (
        Figure(f"{what}: frames accepted that were never sent", never_sent, at_most=0),
        Figure(f"{what}: largest tension let through", tension, "N", at_most=LIMITS.max_tension),
        Figure(f"{what}: most bytes kept by a parser", waiting, at_most=LONGEST_CODED),
        Figure(f"{what}: memory taken in all", memory, "KiB"),
    )
    head = ("how the bytes were made", "bytes", "frames accepted", "never sent", *_REFUSED)
    rows = [(t.way, t.size, t.accepted, t.never_sent, *(t.refused[kind] for kind in _REFUSED)) for t in tallies]
    note = "The coverage-guided search was left out: Atheris is not installed."
    if guided:
        note = (
            f"Coverage-guided (Atheris): {guided['size']} bytes in {guided['inputs']} inputs, most of them behind a"
            f" right check; {guided['accepted']} frames accepted, none that was never sent."
        )
    return Record("fuzzing", "make fuzz", figures, {"bytes": Table.of(head, rows)}, (note,))
