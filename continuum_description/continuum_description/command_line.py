"""What the two command-line tools share: their output option, and errors as one line with exit code 2."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NoReturn

from continuum.errors import ContinuumError, FileError
from continuum.output_files import check_apart
from continuum.whole_file import write_whole


class OneLineParser(argparse.ArgumentParser):
    """A parser that says what is wrong in one line, without its usage."""

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}; see --help\n")


def tool_parser(program: str, description: str, epilog: str, formats: Sequence[str]) -> OneLineParser:
    """A parser with ``--output`` and ``--format``, the first of ``formats`` being the default."""
    parser = OneLineParser(
        prog=program,
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("-o", "--output", metavar="FILE", type=Path, help="write to FILE instead of standard output")
    parser.add_argument("--format", choices=formats, default=formats[0], help=f"what to write (default: {formats[0]})")
    return parser


def run_tool(
    parser: OneLineParser,
    make_text: Callable[[argparse.Namespace], str],
    arguments: Sequence[str] | None,
    inputs: Callable[[argparse.Namespace], Sequence[Path]] = lambda _: (),
) -> int:
    """Parse, make the text, write it to a file that is none of the ``inputs``.

    Returns:
        The exit code: 0, or 2 after a line on standard error.
    """
    options = parser.parse_args(arguments)
    try:
        check_apart([options.output], inputs(options))
        _write(make_text(options), options.output)
    except ContinuumError as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 2
    return 0


def _write(text: str, output: Path | None) -> None:
    if output is None:
        try:
            sys.stdout.write(text)
            sys.stdout.flush()
        except OSError as error:
            raise FileError("standard output", f"cannot be written ({error.strerror})") from error
        return
    write_whole(output, text)
