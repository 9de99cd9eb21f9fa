"""Controls of the view: light or dark, base at the top or bottom, rotation vectors, camera."""

from __future__ import annotations

from typing import Any

import viser

from continuum.viewer.layout import Layout, set_theme
from continuum.viewer.stage import Stage


class ViewControls:
    """A folder of the page, shared by all browsers; only "Reset view" acts on a single browser.

    Args:
        layout: page.
        stage: camera and grid.
        hanging: whether the base is initially at the top.
    """

    def __init__(self, layout: Layout, stage: Stage, hanging: bool = False) -> None:
        gui = layout.server.gui
        self._layout, self._stage, self.dark = layout, stage, False
        with gui.add_folder("View", expand_by_default=False):
            self._dark: viser.GuiCheckboxHandle = gui.add_checkbox("Dark", False)
            self._hanging: viser.GuiCheckboxHandle = gui.add_checkbox(
                "Base at top", hanging, hint="Shows the arm as it hangs. Coordinates do not change: z points from the "
                "base along the straight arm.",
            )  # fmt: skip
            self._vectors: viser.GuiCheckboxHandle = gui.add_checkbox(
                "Rotation axes", False, hint="Purple arrows: the axis about which a section bends, at its centre of "
                "curvature, longer for a larger bend. A straight section has none.",
            )  # fmt: skip
            reset = gui.add_button("Reset view")
        reset.on_click(self._reset)

    @property
    def vectors(self) -> bool:
        """Whether rotation vectors are shown."""
        return bool(self._vectors.value)

    def apply(self) -> None:
        """Apply the settings; called once per frame."""
        self._stage.set_hanging(bool(self._hanging.value))
        if bool(self._dark.value) is not self.dark:
            self.dark = bool(self._dark.value)
            set_theme(self._layout.server, self.dark)
            self._stage.set_dark(self.dark)

    def _reset(self, event: viser.GuiEvent[Any]) -> None:
        if event.client is not None:
            self._stage.reset(event.client)
