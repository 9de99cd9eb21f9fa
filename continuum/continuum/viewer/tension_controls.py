"""Sliders of cable tensions, dead until control is taken, and slack again as soon as it is given back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import viser

from continuum.viewer.layout import Layout


class TensionControls:
    """One slider for each cable.

    Args:
        layout: of the page.
        cables: names of the cables that can be pulled.
        most: largest tension [N].
    """

    def __init__(self, layout: Layout, cables: Sequence[str], most: float) -> None:
        gui = layout.server.gui
        self._sliders: dict[str, viser.GuiSliderHandle[float]] = {}
        with layout.move, gui.add_folder("cable tensions", expand_by_default=False):
            self._taken = gui.add_checkbox("Take control", False, hint="Pulls the cables of a simulated or real arm.")
            for cable in cables:
                label = f"{cable.replace('_', ' ')} [N]"
                self._sliders[cable] = gui.add_slider(label, 0.0, most, 0.1, 0.0, disabled=True)

    @property
    def taken(self) -> bool:
        """Whether the page's user pulls the cables."""
        return bool(self._taken.value)

    def wanted(self) -> Mapping[str, float]:
        """Tensions [N] by name; all 0 where control is not taken, and whenever it is taken anew."""
        for slider in self._sliders.values():
            if slider.disabled is self.taken:
                slider.disabled = not self.taken
                slider.value = 0.0  # type: ignore[misc]
        return {name: slider.value if self.taken else 0.0 for name, slider in self._sliders.items()}

    def give_back(self) -> None:
        """Take control from the page's user, who went away, say."""
        if self.taken:
            self._taken.value = False  # type: ignore[misc]
