"""argparse's parser with one-line error messages and suggestions for misspelt names."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from typing import Any, NoReturn

from continuum.did_you_mean import did_you_mean
from continuum.printable import one_line

_OPTION = re.compile(r"(--?[A-Za-z][^\s=]*)(=.*)?", re.DOTALL)
"""Words that argparse treats as options: not negative numbers, and not words that contain blanks."""


class Parser(argparse.ArgumentParser):
    """Parser that reports unknown options first: their values would otherwise cause misleading messages."""

    def error(self, message: str) -> NoReturn:
        """End with exit code 2 and one line, which refers to --help unless it suggests a name."""
        further = "" if message.endswith("?") else f"; see {self.prog} --help"
        self.exit(2, f"continuum: {one_line(message)}{further}\n")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> tuple[Any, list[str]]:
        """As argparse's method, but surplus words are refused by the command that received them."""
        words: list[str] = list(args or ())
        self._refuse_unknown_options(words)
        found, left = super().parse_known_args(words, namespace)
        if left and not self._has_commands():
            self.error(f"unexpected argument{'s' * (len(left) > 1)}: {' '.join(left)}")
        return found, left

    def _refuse_unknown_options(self, words: Sequence[str]) -> None:
        """Refuse unknown options up to the command, if there is one; later words belong to the command."""
        known = [option for action in self._actions for option in action.option_strings]
        for word in words:
            option = _OPTION.fullmatch(word)
            if word == "--" or (option is None and self._has_commands()):
                return
            if option is None or option[1] in known:
                continue
            beginning = option[1].startswith("--") and any(one.startswith(option[1]) for one in known)
            if not beginning:  # argparse completes an abbreviation, or lists its completions
                self.error(f"{self.prog} has no option {option[1]}{did_you_mean(option[1], known)}")

    def _has_commands(self) -> bool:
        return any(action.nargs == argparse.PARSER for action in self._actions)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse a value that is not among the choices, with a suggestion, which argparse's message lacks."""
        if action.choices is None or value in action.choices:
            return
        known = [str(one) for one in action.choices]
        what = f"{self.prog} has no command" if action.nargs == argparse.PARSER else f"{_name(action)} takes no"
        near = did_you_mean(str(value), known) or f"; known: {', '.join(known)}"
        raise argparse.ArgumentError(None, f"{what} {value!r}{near}")


class ShowVersion(argparse.Action):
    """Print the installed version, read from the package's metadata only on request."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print and end."""
        import importlib.metadata

        print(f"continuum {importlib.metadata.version('continuum')}")
        parser.exit()


def _name(action: argparse.Action) -> str:
    return "/".join(action.option_strings) or str(action.metavar or action.dest)
