"""Sliders of cable tensions, disabled until control is taken and reset to zero when it is returned."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import viser

from continuum.viewer.held_input import Held
from continuum.viewer.layout import Layout, spoken
from continuum.viewer.slider_value import value_within


class TensionControls:
    """One slider for each cable whose tension is published.

    Args:
        layout: page.
        cables: names of the cables of the arm.
        most: largest tension [N].
    """

    def __init__(self, layout: Layout, cables: Sequence[str], most: float) -> None:
        gui = layout.server.gui
        self._pulled: Collection[str] = ()
        self._sliders: dict[str, viser.GuiSliderHandle[float]] = {}
        with layout.move:
            self._folder = gui.add_folder("cable tensions", expand_by_default=False, visible=False)
        with self._folder:
            taken = gui.add_checkbox("Take control", False, hint="Pulls the cables of a simulated or real arm.")
            self._taken = Held(layout.server, taken, False)
            for cable in cables:
                label = f"{spoken(cable)} [N]"
                self._sliders[cable] = gui.add_slider(label, 0.0, most, 0.1, 0.0, disabled=True, visible=False)

    @property
    def taken(self) -> bool:
        """Whether a user controls the tensions."""
        return bool(self._taken.value)

    def offer(self, pulled: Collection[str]) -> None:
        """Show the sliders of published tensions; if none is published any longer, the previous sliders remain."""
        if pulled and set(pulled) != set(self._pulled):
            self._pulled = tuple(pulled)
            self._folder.visible = True
            for name, slider in self._sliders.items():
                slider.visible = name in self._pulled

    def wanted(self) -> Mapping[str, float]:
        """Return the commanded tensions [N] of the shown cables, clipped to the limits of the sliders.

        All are 0 while control is not taken, and again whenever it is taken.
        """
        for slider in self._sliders.values():
            if slider.disabled is self.taken:
                slider.disabled = not self.taken
                slider.value = 0.0  # type: ignore[misc]
        return {name: value_within(self._sliders[name]) if self.taken else 0.0 for name in self._pulled}

    def let_go(self) -> None:
        """Return control if the browser that took it is no longer connected."""
        self._taken.let_go()
