"""Layout of the page: the scene, controls of the arm to its right, measurements to its left."""

from __future__ import annotations

from dataclasses import dataclass

import viser

from continuum.burst_log import BurstLog

_WIDTH = 320
"""Width of the left panel [pixels]."""

NAME = "continuum"


@dataclass(frozen=True)
class Layout:
    """A served page.

    Attributes:
        server: server of the page.
        move: folder of the controls that move the arm.
        plots: tab of the plots over time.
        status: tab of the statuses.
        faults: log of refused messages from browsers.
        words: words that a browser may send, the options of all choices.
    """

    server: viser.ViserServer
    move: viser.GuiFolderHandle
    plots: viser.GuiTabHandle
    status: viser.GuiTabHandle
    faults: BurstLog
    words: set[str]


def spoken(name: str) -> str:
    """Return a name of the arm in readable form."""
    return name.replace("_", " ")


def layout_of(server: viser.ViserServer, faults: BurstLog, words: set[str]) -> Layout:
    """Create the panels of the page."""
    set_theme(server, dark=False)
    server.gui.set_panel_label(NAME)
    panel = server.gui.add_panel()
    plots, status = panel.add_tab("Plots"), panel.add_tab("Status")
    panel.dock_left()
    panel.set_width(_WIDTH)
    return Layout(server, server.gui.add_folder("Arm"), plots, status, faults, words)


def set_theme(server: viser.ViserServer, dark: bool) -> None:
    """Set the page to dark or light."""
    server.gui.configure_theme(
        show_logo=False, show_share_button=False, control_width="medium", dark_mode=dark,
    )  # fmt: skip
