"""Catalogues hold what the code says, all of it, and are compiled as they stand."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest
from babel.messages.catalog import Catalog, Message
from babel.messages.pofile import read_po

from continuum.languages import LANGUAGES
from tools.docs.languages.catalogue import FOLDER, LIBRARY, compiled, messages

SOURCES = sorted(LIBRARY.rglob("*.py"))
PATHS = sorted(FOLDER.glob("*.po"))
each_catalogue = pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
_PLACEHOLDER = re.compile(r"\{[^{}]*\}")


def catalogue_of(path: Path) -> Catalog:
    with path.open("rb") as file:
        return read_po(file)


def sentences(catalogue: Catalog) -> set[object]:
    return {one.id for one in catalogue if one.id}


def forms(one: Message) -> list[tuple[str, str]]:
    """Each form of a sentence with its translation."""
    if isinstance(one.id, str):
        return [(one.id, str(one.string))]
    return list(zip(one.id, one.string, strict=True))


def placeholders(text: str) -> list[str]:
    return sorted(_PLACEHOLDER.findall(text))


def has_words(text: str) -> bool:
    """Whether anything in it could be translated: letters that stand outside of placeholders."""
    return any(mark.isalpha() for mark in _PLACEHOLDER.sub("", text))


def test_every_language_but_english_has_a_catalogue() -> None:
    assert {path.stem for path in PATHS} == {*LANGUAGES} - {"en"}


@each_catalogue
def test_it_has_the_sentences_of_the_code_and_no_others(path: Path) -> None:
    """`make languages` brings them in."""
    assert sentences(catalogue_of(path)) == sentences(messages())


@each_catalogue
def test_every_sentence_is_translated_with_its_placeholders(path: Path) -> None:
    for one in catalogue_of(path):
        for text, translation in forms(one) if one.id else ():
            assert translation.strip(), text
            assert placeholders(translation) == placeholders(text)
            assert (translation != text) == has_words(text), text
            assert (text[:1].isspace(), text[-1:].isspace()) == (
                translation[:1].isspace(),
                translation[-1:].isspace(),
            ), text


@each_catalogue
def test_figures_in_a_sentence_stay(path: Path) -> None:
    """Numbers and placeholders, in their order."""
    figures = re.compile(r"\{[^{}]*\}|\d+(?:\.\d+)?")
    for one in catalogue_of(path):
        for text, translation in forms(one) if one.id else ():
            assert figures.findall(translation) == figures.findall(text)


@each_catalogue
def test_programs_read_what_people_edit(path: Path) -> None:
    assert path.with_suffix(".mo").read_bytes() == compiled(catalogue_of(path)), "run `make languages`"


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.stem)
def test_sentences_are_whole_in_the_code(path: Path) -> None:
    """No catalogue can have a sentence whose values are in it already."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and node.args:
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            if name in ("tr", "Message", "plural"):
                assert not isinstance(node.args[0], ast.JoinedStr | ast.BinOp), f"{path}:{node.lineno}"
