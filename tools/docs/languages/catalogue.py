"""Sentences of the library, collected from its sources, and catalogues of their translations."""

from __future__ import annotations

import io
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path
from typing import Final

from babel.messages.catalog import Catalog
from babel.messages.extract import extract_from_dir
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from continuum.discovery.report.names import small
from continuum.discovery.report.quantities import meaning_in_words
from continuum.dynamics.effect import Effect
from continuum.dynamics.parameters import PARAMETERS, Parameter

LIBRARY: Final = Path(__file__).resolve().parents[3] / "continuum" / "continuum"
FOLDER: Final = LIBRARY / "languages"
"""Where the catalogues are, ``pt.po`` and the like."""

_METHODS: Final = [("**.py", "python"), ("**/templates/**.html", "jinja2.ext:babel_extract")]
_KEYWORDS: Final = {"Message": None, "tr": None, "plural": (1, 2)}
"""Functions whose first argument is a sentence, or whose first two are its forms for one and for several."""
_OF_AN_EFFECT: Final = ("in_words", "in_words_if_more", "in_words_if_less", "in_words_if_lacking", "experiment",
                        "removal", "beware")  # fmt: skip
_WIDTH: Final = 110


def messages() -> Catalog:
    """Return every sentence that the library may print in another language, without translations."""
    found = Catalog(project="continuum", charset="utf-8")
    for path, _, message, _, _ in extract_from_dir(LIBRARY, _METHODS, keywords=_KEYWORDS):
        found.add(message, locations=[(f"continuum/{path}", 0)])
    for module, text in sorted({*_texts_of_effects(), *_texts_of_parameters()}):
        found.add(text, locations=[(f"{module.replace('.', '/')}.py", 0)])
    return found


def updated(path: Path) -> Catalog:
    """Return a catalogue with all sentences of the library: translated as before, or not yet."""
    with path.open("rb") as file:
        catalogue = read_po(file)
    catalogue.update(messages(), no_fuzzy_matching=True, update_creation_date=False)
    catalogue.obsolete.clear()
    return catalogue


def as_text(catalogue: Catalog) -> bytes:
    """Return the file that people edit."""
    file = io.BytesIO()
    write_po(file, catalogue, width=_WIDTH, include_lineno=False, sort_by_file=True)
    return file.getvalue()


def compiled(catalogue: Catalog) -> bytes:
    """Return the file that programs read."""
    file = io.BytesIO()
    write_mo(file, catalogue)
    return file.getvalue()


def _texts_of_effects() -> Iterator[tuple[str, str]]:
    """Yield what the library's effects say of themselves and of their parameters, with the module of each."""
    for entry in metadata.entry_points(group="continuum.effects"):
        effect: type[Effect] = entry.load()
        if entry.module.startswith("continuum.effects."):
            texts = [getattr(effect, name) for name in _OF_AN_EFFECT]
            texts += [text for name, spec in effect.parameters.items() for text in _texts_of(name, spec)]
            yield from ((entry.module, text) for text in texts if text)


def _texts_of_parameters() -> Iterator[tuple[str, str]]:
    """Yield the same of the model's parameters."""
    for name, spec in PARAMETERS.items():
        yield from ((Parameter.__module__, text) for text in _texts_of(name, spec))


def _texts_of(name: str, spec: Parameter) -> Iterator[str]:
    """Yield a parameter's name, its meaning, and how it is measured by hand: at one joint, too."""
    yield name.replace("_", " ")
    yield meaning_in_words(spec.meaning)
    if spec.by_hand is not None:
        yield spec.by_hand.how
        if spec.per_joint and not spec.per_recording:
            yield small(spec.by_hand.how)
