"""Code blocks of a Markdown page, and the commands of a shell block."""

import re
import shlex
from dataclasses import dataclass

_FENCE = re.compile(r"^```(.*)$")


@dataclass(frozen=True)
class Block:
    """A code block: its language, its text, and the line of the page where it begins."""

    language: str
    text: str
    line: int

    @property
    def commands(self) -> list[str]:
        """Commands of a shell block: lines, joined where a backslash or an open quote asks for it, without comments.

        Raises:
            ValueError: a command does not end.
        """
        found, begun = [], ""
        for line in self.text.splitlines():
            begun += line
            if not line.endswith("\\") and _is_whole(begun):
                words = shlex.split(begun, comments=True)
                found += [begun] if words else []
                begun = ""
            else:
                begun += "\n"
        if begun:
            raise ValueError(f"line {self.line}: a command does not end: {begun!r}")
        return found


def blocks(page: str) -> list[Block]:
    """All code blocks of a page.

    Raises:
        ValueError: a block does not end.
    """
    found: list[Block] = []
    language, begin, text = None, 0, list[str]()
    for number, line in enumerate(page.splitlines(), 1):
        fence = _FENCE.match(line)
        if language is None and fence:
            language, begin, text = fence[1].strip(), number, []
        elif language is not None and line == "```":
            found.append(Block(language, "\n".join(text), begin))
            language = None
        elif language is not None:
            text.append(line)
    if language is not None:
        raise ValueError(f"line {begin}: a block does not end")
    return found


def words(command: str) -> str:
    """A command's words with one blank between them, without comments."""
    return " ".join(shlex.split(command.replace("\\\n", " "), comments=True))


def without_comment(command: str) -> str:
    """A command without the comment at its end, as these pages write them: four blanks before it."""
    return command.partition("    # ")[0]


def _is_whole(text: str) -> bool:
    try:
        shlex.split(text, comments=True)
    except ValueError:
        return False
    return True
