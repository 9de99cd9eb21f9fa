"""The page of the rows, docs/equations.md."""

from __future__ import annotations

from collections.abc import Sequence

from tools.docs.equations.rows import Row
from tools.docs.markdown import table

KINDS = {"Eq.": "Equations", "Table": "Tables", "Figure": "Figures"}
"""Headings of the page's parts by what the thesis numbers."""

COUNTERPART = "function, command or file"
"""What a row names here, as the head of its column."""

_HEAD = """\
# The thesis, equation by equation

Where each numbered equation, table and figure of the thesis is in this workspace, and which test covers it. Made by
`make equations`, which looks every name up; it fails where a function, a command or a test is not there.

"Erratum" marks what is wrong as printed: [errata.md](errata.md) says what it should be, and why. The docstring of a
function names its equation. Run one test with `pytest PATH::NAME`.
"""


def page(rows: Sequence[Row]) -> str:
    """The whole page: a table for each kind of row, then the counts."""
    parts = [_HEAD]
    for kind, heading in KINDS.items():
        parts.append(f"## {heading}\n\n{_rows([row for row in rows if row.kind == kind])}\n")
    parts.append(f"## Counts\n\n{_counts(rows)}\n")
    return "\n".join(parts)


def _rows(rows: Sequence[Row]) -> str:
    """One line for each; a reason stands in the first cell that has nothing else."""
    lines = []
    for row in rows:
        names, tests = _listed(row.names), _listed(row.tests)
        lines.append((row.number, row.what, names or row.reason, tests or (row.reason if names else "")))
    return table(("number", "what", COUNTERPART, "test"), lines)


def _listed(names: Sequence[str]) -> str:
    return "<br>".join(f"`{name}`" for name in names)


def _counts(rows: Sequence[Row]) -> str:
    parts = {heading: [row for row in rows if row.kind == kind] for kind, heading in KINDS.items()}
    return table(
        ("", "rows", f"with a {COUNTERPART}", "with a test"),
        [
            (heading.lower(), len(part), sum(bool(row.names) for row in part), sum(bool(row.tests) for row in part))
            for heading, part in (parts | {"all": rows}).items()
        ],
    )
