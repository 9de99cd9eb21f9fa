"""The model file that a command works with: the option that names it, and the model in it."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from continuum.cli.completion import completes_files
from continuum.errors import FileError, InvalidValueError
from continuum.shipped_files import MODELS

if TYPE_CHECKING:
    from continuum.dynamics.model import Model


DEFAULT_MODEL = "lamecc_prototype.yaml"
"""Model of commands that name none."""


def add_model_option(parser: argparse.ArgumentParser, what: str = "model file") -> None:
    """Add ``--model``, a path or the name of a model that comes with the library, and ``--section``."""
    option = parser.add_argument(
        "--model", metavar="MODEL.yaml", default=DEFAULT_MODEL,
        help=f"{what}, or arm file with a block `dynamics`, or one of the library's; default %(default)s",
    )  # fmt: skip
    completes_files(option, MODELS)
    parser.add_argument(
        "--section", metavar="NAME",
        help="section of an arm file, modelled with its base fixed; required where the file has several",
    )  # fmt: skip


def read_model(name: str, section: str | None = None) -> Model:
    """The model of a file, or of a shipped one by its name.

    Args:
        name: the file.
        section: of an arm file; None where it has only one.

    Raises:
        FileError: there is no such file or model, it cannot be read, or none of its sections is named.
        InvalidValueError: a value in it is not allowed.
    """
    from continuum.dynamics.model_file import load_named_model  # here, so that help need not wait for it

    try:
        model, found = load_named_model(name, section)
    except InvalidValueError as error:
        if error.name != f"{name}: section":
            raise
        problem = "has several sections" if section is None else f"has no section {section}"
        sections = error.allowed.partition(";")[0]
        raise FileError(name, f"{problem}; a simulation is of one: name it with --section, {sections}") from None
    if section is not None and found is None:
        raise InvalidValueError("--section", section, f"left out: {name} is a model file, which has no sections")
    return model
