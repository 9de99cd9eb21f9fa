"""Code blocks of a Markdown page, and the commands of a shell block."""

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass, replace

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
    return [part for part in _parts(page) if isinstance(part, Block)]


def outside_of_blocks(page: str) -> str:
    """The page without its code blocks.

    Raises:
        ValueError: a block does not end.
    """
    return "\n".join(part for part in _parts(page) if isinstance(part, str))


def _parts(page: str) -> Iterator[Block | str]:
    """Blocks, and the lines outside of them."""
    begun: Block | None = None
    for number, line in enumerate(page.splitlines(), 1):
        fence = _FENCE.match(line)
        if begun is None and fence:
            begun = Block(fence[1].strip(), "", number)
        elif begun is None:
            yield line
        elif line == "```":
            yield begun
            begun = None
        else:
            begun = replace(begun, text=f"{begun.text}{line}\n")
    if begun is not None:
        raise ValueError(f"line {begun.line}: a block does not end")


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
