"""How templates become pages: inserted values are escaped, and undefined ones are errors."""

from __future__ import annotations

import jinja2

from continuum.printable import one_line


def environment() -> jinja2.Environment:
    """Return an environment that escapes inserted values and keeps names, with whatever characters, on one line."""
    return jinja2.Environment(
        loader=jinja2.PackageLoader(__package__),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        finalize=lambda value: one_line(value) if type(value) is str else value,
    )
