"""Position of the tip and spacing of the grid as numbers."""

from __future__ import annotations

import time

from continuum.arrays import Array
from continuum.viewer.layout import Layout
from continuum.viewer.section_plots import PERIOD


class Readout:
    """A table on the page.

    Args:
        layout: page.
        grid: spacing of the grid in words.
    """

    def __init__(self, layout: Layout, grid: str) -> None:
        self._due, self._grid, self._shown = 0.0, grid, ""
        with layout.move:
            self._table = layout.server.gui.add_markdown("", order=-1.0)
        self.show(None)

    def show(self, tip: Array | None) -> None:
        """Show the position of the tip, (3,) [m], None if unknown; sent if changed, at most as often as plots."""
        if time.monotonic() >= self._due:
            self._due = time.monotonic() + PERIOD
            numbers = ["–"] * 3 if tip is None else [f"{1e3 * part:.1f}" for part in tip]
            text = "Tip [mm]: " + ", ".join(f"{axis} **{n}**" for axis, n in zip("xyz", numbers, strict=True))
            text += f"\n\nGrid: {self._grid}"
            if text != self._shown:
                self._shown = self._table.content = text
