"""Text with substitutions, ``a$(var b)c``, as a list of parts; nothing is evaluated here."""

from __future__ import annotations

from dataclasses import dataclass

from ros2_standin.errors import UserError


@dataclass(frozen=True)
class Call:
    """One ``$(name argument ...)``; each argument is a template of its own."""

    name: str
    arguments: tuple[Template, ...]


Template = tuple[str | Call, ...]


def parse_template(text: str) -> Template:
    """The parts of ``text``; a backslash is lost and the next character taken as it is, as in the stock grammar.

    Raises:
        UserError: a bracket or quote is not closed, or a substitution has no name.
    """
    return _Reader(text).read(stop="")[0]


class _Reader:
    def __init__(self, text: str) -> None:
        self._text = text

    def read(self, stop: str, begin: int = 0) -> tuple[Template, int]:
        """Parts from ``begin`` to the first of the characters ``stop`` (not consumed), or to the end."""
        parts: list[str | Call] = []
        literal = ""
        at = begin
        while at < len(self._text) and self._text[at] not in stop:
            if self._text.startswith("$(", at):
                call, at = self._call(at)
                parts += [literal, call] if literal else [call]
                literal = ""
            elif self._text[at] == "\\" and at + 1 < len(self._text):
                literal += self._text[at + 1]
                at += 2
            else:
                literal += self._text[at]
                at += 1
        return (tuple(parts) + ((literal,) if literal else ())), at

    def _call(self, begin: int) -> tuple[Call, int]:
        """The substitution at ``begin``, and where it ends."""
        words: list[Template] = []
        at = begin + 2
        while True:
            while at < len(self._text) and self._text[at].isspace():
                at += 1
            if at >= len(self._text):
                raise UserError(f"the bracket of {self._text[begin:]!r} is not closed")
            if self._text[at] == ")":
                break
            word, at = self._word(at)
            words.append(word)
        if not words or len(words[0]) != 1 or not isinstance(words[0][0], str):
            raise UserError(f"{self._text[begin : at + 1]!r} names no substitution")
        return Call(words[0][0], tuple(words[1:])), at + 1

    def _word(self, at: int) -> tuple[Template, int]:
        quote = self._text[at]
        if quote in "'\"":
            word, end = self.read(stop=quote, begin=at + 1)
            if end >= len(self._text):
                raise UserError(f"the quote of {self._text[at:]!r} is not closed")
            return word, end + 1
        return self.read(stop=" \t\n\r)", begin=at)


def split_words(template: Template) -> list[Template]:
    """The words of a command line, parted at white space outside quotes.

    A substitution never comes apart, so a path with a space in it stays one word.

    Raises:
        UserError: a quote is not closed.
    """
    words: list[list[str | Call]] = []
    inside = False
    quote = ""
    for part in template:
        for piece in part if isinstance(part, str) else (part,):
            if quote == piece and quote:
                quote = ""
            elif not quote and piece in ("'", '"'):
                quote = piece
                words += [] if inside else [[]]
                inside = True
            elif not quote and isinstance(piece, str) and piece.isspace():
                inside = False
            else:
                words += [] if inside else [[]]
                inside = True
                words[-1].append(piece)
    if quote:
        raise UserError(f"a quote {quote} is not closed")
    return [_joined(word) for word in words]


def _joined(pieces: list[str | Call]) -> Template:
    """Single characters put together to texts again."""
    parts: list[str | Call] = []
    for piece in pieces:
        if isinstance(piece, str) and parts and isinstance(parts[-1], str):
            parts[-1] += piece
        else:
            parts.append(piece)
    return tuple(parts)
