"""XML elements that know their file and line, for errors that a reader can act on."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from pathlib import Path
from xml.parsers import expat

from ros2_standin.errors import UserError


class PlacedError(UserError):
    """A mistake in a launch file; begins with file and line."""


@dataclass
class Element:
    """One tag with its attributes and children."""

    tag: str
    attributes: dict[str, str]
    file: Path
    line: int
    children: list[Element] = field(default_factory=list)

    def error(self, problem: str) -> PlacedError:
        """An error that begins with file, line and tag."""
        return PlacedError(f"{self.file}:{self.line}: <{self.tag}> {problem}")

    def check(self, attributes: Collection[str], children: Collection[str] = ()) -> None:
        """Raise UserError for an attribute or a child tag that is not among these."""
        for name in self.attributes:
            if name not in attributes:
                raise self.error(f"has the attribute '{name}'; covered here: {', '.join(sorted(attributes)) or 'none'}")
        for child in self.children:
            if child.tag not in children:
                raise child.error(f"within <{self.tag}>; covered here: {', '.join(sorted(children)) or 'none'}")

    def required(self, name: str) -> str:
        """An attribute that must be there."""
        if name not in self.attributes:
            raise self.error(f"lacks the attribute '{name}'")
        return self.attributes[name]


def read_xml(file: Path) -> Element:
    """The root element of a file.

    Raises:
        UserError: the file cannot be read, is no XML, or has text between its tags.
    """
    try:
        data = file.read_bytes()
    except OSError as error:
        raise UserError(f"{file}: {error.strerror}") from error
    parser = expat.ParserCreate()
    top = Element("", {}, file, 0)
    open_elements = [top]

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, file, parser.CurrentLineNumber)
        open_elements[-1].children.append(element)
        open_elements.append(element)

    def text(characters: str) -> None:
        if characters.strip():
            raise PlacedError(
                f"{file}:{parser.CurrentLineNumber}: the text {characters.strip()!r} belongs to no attribute"
            )

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _tag: open_elements.pop()
    parser.CharacterDataHandler = text
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise PlacedError(f"{file}:{error.lineno}: not XML: {expat.ErrorString(error.code)}") from error
    return top.children[0]
