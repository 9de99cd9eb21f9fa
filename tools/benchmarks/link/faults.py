"""The faults of the campaign, and its cases: each fault alone, and all pairs."""

from __future__ import annotations

from itertools import combinations

LASTS = 2.0
"""Duration of every fault [s]."""

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
"""Orders to the emulator, by name."""

NO_DRIFT = "drift ppm=0"
"""Order that ends the fault without an end."""

CASES = [*((name,) for name in FAULTS), *combinations(FAULTS, 2)]


def orders(case: tuple[str, ...]) -> list[str]:
    """Return the orders at the start of a case; unplugging comes last, so that the other fault starts before it."""
    return [FAULTS[name] for name in sorted(case, key=lambda name: name == "unplugged")]
