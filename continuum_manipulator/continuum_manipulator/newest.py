"""What came since the last look, of all that is about the same the last alone."""

from __future__ import annotations

from collections.abc import Hashable


class Newest[T]:
    """Kept as it comes, taken once for each frame."""

    def __init__(self) -> None:
        self._kept: dict[Hashable, T] = {}

    def keep(self, about: Hashable, item: T) -> None:
        """Keep an item in the place of an earlier one about the same."""
        self._kept[about] = item

    def take(self) -> list[T]:
        """All that came since the last time, in the order of their subjects' first."""
        kept, self._kept = self._kept, {}
        return list(kept.values())
