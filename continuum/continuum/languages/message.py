"""A sentence that is made where no language is known."""

from __future__ import annotations

from collections.abc import Mapping


class Message(str):
    """An English sentence that keeps its template and values, so that a `Translator` can say it in another language.

    As a string it is the sentence itself: ``Message("bend by {angle:.0f} degrees", angle=3.2) == "bend by 3 degrees"``.
    Without values it is its template, to which the translator gives the values.

    Attributes:
        template: the sentence with named placeholders.
        values: what they stand for; messages among them are translated too.
    """

    template: str
    values: Mapping[str, object]

    def __new__(cls, template: str, /, **values: object) -> Message:
        one = super().__new__(cls, template.format(**values) if values else template)
        one.template, one.values = template, values
        return one

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, object]]:
        """As it is from process to process."""
        return (self.template,), dict(self.values)
