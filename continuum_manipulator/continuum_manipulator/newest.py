"""Collection of the newest item of each subject."""

from __future__ import annotations

from collections.abc import Hashable


class Newest[T]:
    """The newest item of each subject since the last call of :meth:`take`."""

    def __init__(self) -> None:
        self._kept: dict[Hashable, T] = {}

    def keep(self, about: Hashable, item: T) -> None:
        """Store an item, replacing an earlier one with the same subject."""
        self._kept[about] = item

    def take(self) -> list[T]:
        """Remove and return all items, in the order in which their subjects first arrived."""
        kept, self._kept = self._kept, {}
        return list(kept.values())
