"""How templates become pages: what is put into a page is escaped, and nothing is left undefined."""

from __future__ import annotations

import jinja2

from continuum.printable import one_line


def environment() -> jinja2.Environment:
    """Escapes all that is put into the page; names of recordings, of which any character may be part, stay one line."""
    return jinja2.Environment(
        loader=jinja2.PackageLoader(__package__),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        finalize=lambda value: one_line(value) if type(value) is str else value,
    )
