"""Completion of the command line in bash and zsh by argcomplete, which the shell calls while the user types."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

_ASKED = "_ARGCOMPLETE"
"""Environment variable by which a shell asks for completions."""


def complete(parser: argparse.ArgumentParser) -> None:
    """Answer a shell's request for completions and end the process; do nothing without such a request."""
    if _ASKED in os.environ:
        import argcomplete

        argcomplete.autocomplete(parser)


def completes_files(action: argparse.Action, folder: Path, *suffixes: str) -> None:
    """Complete an argument by names of files in the library, YAML files, and files of other ``suffixes``."""

    def names(prefix: str) -> list[str]:
        from argcomplete.completers import FilesCompleter

        from continuum.shipped_files import shipped_names

        return [*shipped_names(folder), *FilesCompleter(("yaml", "yml", *suffixes))(prefix)]

    completes(action, names)


def completes(action: argparse.Action, names: Callable[[str], Iterable[str]]) -> None:
    """Complete an argument by the names that ``names`` returns for its beginning."""

    def completer(prefix: str, **_: Any) -> Iterable[str]:
        return names(prefix)

    action.completer = completer  # type: ignore[attr-defined]
