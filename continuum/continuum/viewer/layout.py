"""Where things stand on the page: the scene, what moves the arm on its right, what is measured on its left."""

from __future__ import annotations

from dataclasses import dataclass

import viser

from continuum.burst_log import BurstLog

_WIDTH = 320
"""Of the panel on the left [pixels]."""

NAME = "continuum"


@dataclass(frozen=True)
class Layout:
    """A served page.

    Attributes:
        server: of the page.
        move: what moves the arm.
        plots: plots over time.
        status: statuses.
        faults: where it is noted what a browser must not say.
        words: that a browser may say: options of what there is to choose.
    """

    server: viser.ViserServer
    move: viser.GuiFolderHandle
    plots: viser.GuiTabHandle
    status: viser.GuiTabHandle
    faults: BurstLog
    words: set[str]


def spoken(name: str) -> str:
    """A name of the arm's, as people read it."""
    return name.replace("_", " ")


def layout_of(server: viser.ViserServer, faults: BurstLog, words: set[str]) -> Layout:
    """Make the panels."""
    set_theme(server, dark=False)
    server.gui.set_panel_label(NAME)
    panel = server.gui.add_panel()
    plots, status = panel.add_tab("Plots"), panel.add_tab("Status")
    panel.dock_left()
    panel.set_width(_WIDTH)
    return Layout(server, server.gui.add_folder("Arm"), plots, status, faults, words)


def set_theme(server: viser.ViserServer, dark: bool) -> None:
    """Make the page dark or light."""
    server.gui.configure_theme(
        show_logo=False, show_share_button=False, control_width="medium", dark_mode=dark,
    )  # fmt: skip
