"""Table of the statuses of sensors, link and nodes."""

from __future__ import annotations

import html
from collections.abc import Iterable

from continuum.viewer.layout import Layout
from continuum.viewer.seen import Status

_WORDS = ("well", "warning", "error", "stale")
_COLOURS = ("#1a8f3c", "#b07800", "#d02020", "#808080")
_NOTHING = "<p>No status reported.</p>"


class StatusTable:
    """Table in the panel of statuses, sent only when a status has changed.

    Args:
        layout: page.
    """

    def __init__(self, layout: Layout) -> None:
        self._shown: tuple[Status, ...] = ()
        with layout.status:
            self._table = layout.server.gui.add_html(_NOTHING)

    def show(self, statuses: tuple[Status, ...]) -> None:
        if statuses != self._shown:
            self._shown = statuses
            self._table.content = _table(statuses) if statuses else _NOTHING


def _table(statuses: Iterable[Status]) -> str:
    """Return the table as HTML; names and messages are escaped."""
    rows = "".join(
        f'<tr><td style="vertical-align:top"><span style="color:{_COLOURS[level]}">&#9679; {_WORDS[level]}</span></td>'
        f'<td style="padding-left:0.6em"><b>{html.escape(status.name)}</b><br>{html.escape(status.message)}</td></tr>'
        for status in statuses
        for level in [min(max(status.level, 0), 3)]
    )
    return f'<table style="font-size:0.8em;margin:0.6em;border-spacing:0 0.4em">{rows}</table>'
