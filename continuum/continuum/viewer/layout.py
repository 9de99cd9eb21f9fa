"""Where things stand on the page: the scene, and three tabs beside it."""

from __future__ import annotations

from dataclasses import dataclass

import viser


@dataclass(frozen=True)
class Layout:
    """A served page.

    Attributes:
        server: of the page.
        move: tab of what moves the arm.
        cables: tab of plots.
        status: tab of statuses.
    """

    server: viser.ViserServer
    move: viser.GuiTabHandle
    cables: viser.GuiTabHandle
    status: viser.GuiTabHandle


def layout_of(server: viser.ViserServer) -> Layout:
    """Make the tabs."""
    server.gui.configure_theme(show_logo=False, show_share_button=False, control_width="medium")
    server.gui.set_panel_label("continuum")
    tabs = server.gui.add_tab_group()
    return Layout(server, tabs.add_tab("Arm"), tabs.add_tab("Cables"), tabs.add_tab("Status"))
