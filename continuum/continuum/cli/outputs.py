"""What a command writes: checked before it begins, with folders made and every file announced; or JSON on stdout."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from continuum.languages import ENGLISH, Translator
from continuum.output_files import check_apart, check_page, check_picture, check_writable, folder_of
from continuum.printable import one_line, printable

type Output = str | Path | None
"""A file to write, or None where none was asked for."""


def check_outputs(
    inputs: Sequence[str | Path | None],
    files: Sequence[Output] = (),
    pictures: Sequence[Output] = (),
    pages: Sequence[Output] = (),
) -> None:
    """Refuse what cannot be written, has a wrong suffix, is read, or would be written twice; nothing is changed.

    Raises:
        FileError: the first of these.
    """
    for path in pages:
        check_page(path)
    for path in files:
        check_writable(path)
    for path in pictures:
        check_picture(path)
    check_apart((*files, *pages, *pictures), inputs)


def write(path: Output, write_to: Callable[[str | Path], object]) -> None:
    """Write a file that was asked for, with the folders that it needs.

    Raises:
        FileError: it cannot be written.
    """
    if path is not None:
        with folder_of(path):
            write_to(path)


def announce(paths: Sequence[Output], otherwise: str = "", *, apart: bool = False, tr: Translator = ENGLISH) -> None:
    """Print a line for every file that was written.

    Args:
        paths: what was written, None where nothing was.
        otherwise: printed where nothing was written at all.
        apart: on stderr, as stdout holds a result for machines; then ``otherwise`` is left out.
        tr: to the language of the output.
    """
    written = [path for path in paths if path is not None]
    for path in written:
        print(tr("written: {path}", path=one_line(printable(str(path)))), file=sys.stderr if apart else sys.stdout)
    if not written and otherwise and not apart:
        print(otherwise)


def print_json(result: Mapping[str, object]) -> None:
    """Print one line of JSON; what is no finite number is null."""
    print(json.dumps(_plain(result), allow_nan=False))


def _plain(value: object) -> object:
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
