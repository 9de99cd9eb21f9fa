"""Opening a page in the user's browser."""

from __future__ import annotations

import os
import sys
import threading
import webbrowser


def has_window() -> bool:
    """Return whether a user at a terminal has a screen for a browser; not so in a pipe, a test or a remote shell."""
    screen = sys.platform in ("darwin", "win32") or "DISPLAY" in os.environ or "WAYLAND_DISPLAY" in os.environ
    return sys.stdout.isatty() and screen


def open_window(address: str) -> None:
    """Open ``address`` in the default browser if there is a screen; otherwise the user opens the printed address.

    Returns at once: `webbrowser.open` waits for the end of a browser that runs in the terminal.
    """
    if has_window():
        threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
