"""Sliders of cable tensions, dead until control is taken, and slack again as soon as it is given back."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import viser

from continuum.viewer.held_input import Held
from continuum.viewer.layout import Layout, spoken
from continuum.viewer.slider_value import value_within


class TensionControls:
    """One slider for each cable that somebody says the tension of; none while nobody does.

    Args:
        layout: of the page.
        cables: names of the arm's cables.
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
        """Whether the page's user pulls the cables."""
        return bool(self._taken.value)

    def offer(self, pulled: Collection[str]) -> None:
        """Show the sliders of the cables whose tensions somebody says; those offered before stay where nobody does."""
        if pulled and set(pulled) != set(self._pulled):
            self._pulled = tuple(pulled)
            self._folder.visible = True
            for name, slider in self._sliders.items():
                slider.visible = name in self._pulled

    def wanted(self) -> Mapping[str, float]:
        """Tensions [N] of the cables that are offered, within limits whatever a browser says.

        All are 0 where control is not taken, and whenever it is taken anew.
        """
        for slider in self._sliders.values():
            if slider.disabled is self.taken:
                slider.disabled = not self.taken
                slider.value = 0.0  # type: ignore[misc]
        return {name: value_within(self._sliders[name]) if self.taken else 0.0 for name in self._pulled}

    def let_go(self) -> None:
        """Take control from a user who went away."""
        self._taken.let_go()
