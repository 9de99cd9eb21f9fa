"""From English to the language of a reader, by a catalogue of whole sentences."""

from __future__ import annotations

from dataclasses import dataclass
from gettext import GNUTranslations, NullTranslations
from importlib import resources
from typing import Final

from continuum.errors import InvalidValueError
from continuum.languages.message import Message

LANGUAGES: Final = ("en", "pt")
"""English, and what there is a catalogue of."""


@dataclass(frozen=True)
class Translator:
    """Translates sentences, then fills their named placeholders; what the catalogue lacks stays English.

    Attributes:
        catalogue: translations by English sentence.
    """

    catalogue: NullTranslations

    def __call__(self, text: str, /, **values: object) -> str:
        """Translate a sentence with placeholders, or a `Message`, which may have its values already."""
        if not text:
            return ""
        template, known = (text.template, text.values) if isinstance(text, Message) else (text, {})
        return self._filled(self.catalogue.gettext(template), {**known, **values})

    def plural(self, one: str, several: str, number: int, /, **values: object) -> str:
        """Translate the first sentence for one thing, the second for several, in the forms that the language has."""
        return self._filled(self.catalogue.ngettext(one, several, number), values)

    @property
    def tag(self) -> str:
        """The language as pages name it (BCP 47): ``en``, ``pt-BR``."""
        return self.catalogue.info().get("language", "en").replace("_", "-")

    def _filled(self, template: str, values: dict[str, object]) -> str:
        if not values:
            return template
        return template.format(
            **{name: self(value) if isinstance(value, Message) else value for name, value in values.items()}
        )


ENGLISH: Final = Translator(NullTranslations())


def translator(language: str) -> Translator:
    """Return the translator to one of `LANGUAGES`.

    Raises:
        InvalidValueError: another language.
    """
    if language not in LANGUAGES:
        raise InvalidValueError("language", language, " or ".join(LANGUAGES))
    if language == "en":
        return ENGLISH
    with resources.files(__package__).joinpath(f"{language}.mo").open("rb") as file:
        return Translator(GNUTranslations(file))
