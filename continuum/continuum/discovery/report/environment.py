"""How templates become pages: inserted values are escaped, and undefined ones are errors."""

from __future__ import annotations

from dataclasses import dataclass

import jinja2
from markupsafe import Markup

from continuum.languages import Translator
from continuum.printable import one_line


@dataclass(frozen=True)
class _InTemplates:
    """A translator whose sentences are the page's own, and whose values are escaped."""

    tr: Translator

    def sentence(self, text: str, **values: object) -> Markup:
        return _filled(self.tr(text), values)

    def plural(self, one: str, several: str, number: int, **values: object) -> Markup:
        return _filled(self.tr.plural(one, several, number), values)


def _filled(text: str, values: dict[str, object]) -> Markup:
    """Insert values as templates do."""
    return Markup(text).format(**{name: _on_one_line(value) for name, value in values.items()})  # noqa: S704 - ours


def _on_one_line(value: object) -> object:
    return one_line(value) if type(value) is str else value


def environment(tr: Translator) -> jinja2.Environment:
    """Return an environment that escapes inserted values and keeps names, with whatever characters, on one line.

    Templates call ``tr("sentence", name=value)`` and ``plural("one", "several", number)``.
    """
    found = jinja2.Environment(
        loader=jinja2.PackageLoader(__package__),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        finalize=_on_one_line,
    )
    words = _InTemplates(tr)
    found.globals.update(tr=words.sentence, plural=words.plural, language=tr.tag)
    return found
