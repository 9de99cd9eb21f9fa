"""The option that names the language of what a command prints."""

from __future__ import annotations

import argparse

from continuum.languages import LANGUAGES


def add_language_option(parser: argparse.ArgumentParser, what: str) -> None:
    """Add ``--lang`` for ``what`` the command makes for readers."""
    parser.add_argument(
        "--lang", choices=LANGUAGES, default=LANGUAGES[0], metavar="LANGUAGE",
        help=f"language of the {what}: {', '.join(LANGUAGES)}; default %(default)s",
    )  # fmt: skip
