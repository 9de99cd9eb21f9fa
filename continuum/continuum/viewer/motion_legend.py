"""Legend of the drawn arms: the motion that each of them shows."""

from __future__ import annotations

import html
from collections.abc import Iterable

from continuum.cable_colours import Colour
from continuum.viewer.screen_colours import css


def motion_legend(motions: Iterable[tuple[str, Colour]]) -> str:
    """Return HTML that names each motion in its colour; the first is drawn solid, the others as ghosts."""
    rows = "".join(
        f'<div style="overflow-wrap:anywhere"><span style="color:{css(colour, dark=False)}">&#9632;</span> '
        f"{html.escape(label)}{', ghost' if i else ', solid'}</div>"
        for i, (label, colour) in enumerate(motions)
    )
    return f'<div style="font-size:0.8em;margin:0 0.9em 0.6em">{rows}</div>'
