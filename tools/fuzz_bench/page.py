"""docs/bench-fuzzing.md, from what was found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tools.fuzz_bench.campaign import LIMITS, Tally
from tools.markdown import paragraph, table

_REFUSED = ("too long", "too short", "not COBS", "checksum", "other version", "unknown type", "payload")


def page(tallies: Sequence[Tally], guided: Mapping[str, int] | None) -> str:
    """The page."""
    total = sum(tally.size for tally in tallies) + (guided["size"] if guided else 0)
    memory = max(tally.memory for tally in tallies)
    waiting = max([*(tally.waiting for tally in tallies), guided["waiting"] if guided else 0])
    tension = max(tally.largest_tension for tally in tallies)
    parts = [
        "# Bench protocol: fuzzing",
        paragraph(
            "Made by `make fuzz`. Bytes of a fixed generator, each through the host's parser, and through the device's",
            "with the rules of safety behind it. Nothing raised an exception.",
        ),
        paragraph(
            f"{total / 1e6:.1f} million bytes; {sum(tally.never_sent for tally in tallies)} frames accepted that were",
            f"never sent; at most {waiting} bytes kept by a parser and {memory / 1024:.0f} KiB of memory taken in all.",
            f"Largest tension let through {tension:g} N, of {LIMITS.max_tension:g} N allowed.",
        ),
        table(
            ("how the bytes were made", "bytes", "frames accepted", "never sent", *_REFUSED),
            [(t.way, t.size, t.accepted, t.never_sent, *(t.refused[kind] for kind in _REFUSED)) for t in tallies],
        ),
    ]
    if guided:
        parts.append(
            paragraph(
                f"Coverage-guided (Atheris): {guided['size']} bytes in {guided['inputs']} inputs, most of them behind",
                f"a right check; {guided['accepted']} frames accepted, none that was never sent.",
            )
        )
    parts.append(
        paragraph(
            "Frames behind a right check count as sent, whatever is in them. Both parsers hear all, so that a",
            "sound frame for the one is of an unknown type to the other. By chance a stretch made up at random has",
            "a right check once in 2^32.",
        )
    )
    return "\n\n".join(parts) + "\n"
