"""The faults of the campaign, and the cases made of them: each alone, and all pairs."""

from __future__ import annotations

from itertools import combinations

LASTS = 2.0
"""Of every fault [s]."""

FAULTS = {
    "lost": f"lose share=0.3 for={LASTS} way=both",
    "damaged": f"damage share=0.3 for={LASTS} way=both",
    "repeated": f"repeat share=0.5 for={LASTS} way=both",
    "late": f"late share=0.5 by=0.2 for={LASTS} way=both",
    "noise": f"noise share=0.5 size=200 for={LASTS} way=both",
    "drop-out": f"drop sensor=3 for={LASTS}",
    "clipping": f"clip sensor=5 range=20 for={LASTS}",
    "drift": "drift ppm=500",
    "unplugged": f"unplug for={LASTS}",
}
"""What the emulator is told, by name."""

NO_DRIFT = "drift ppm=0"
"""Ends the one that does not end by itself."""

CASES = [*((name,) for name in FAULTS), *combinations(FAULTS, 2)]


def orders(case: tuple[str, ...]) -> list[str]:
    """For the beginning of a case; a port that goes is the last, or its turn would come before the other fault's."""
    return [FAULTS[name] for name in sorted(case, key=lambda name: name == "unplugged")]
