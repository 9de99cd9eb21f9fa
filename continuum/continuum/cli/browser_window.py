"""A page that is served here, opened in the user's browser."""

from __future__ import annotations

import os
import sys
import webbrowser


def has_window() -> bool:
    """Whether a user at a terminal has a screen on which a browser can open; no pipe, test or remote shell has."""
    screen = sys.platform in ("darwin", "win32") or "DISPLAY" in os.environ or "WAYLAND_DISPLAY" in os.environ
    return sys.stdout.isatty() and screen


def open_window(address: str) -> None:
    """Open ``address`` in the default browser, where there is one; otherwise the user opens what was printed."""
    if has_window():
        webbrowser.open(address)
