"""HTML pages of modules from their docstrings and types."""

from __future__ import annotations

import importlib.util
import pkgutil
import warnings
from collections.abc import Iterable
from pathlib import Path

import pdoc
import pdoc.render


def modules_of(package: str) -> list[str]:
    """Return the dotted names of a package and all its modules, including those that an ``__all__`` does not list.

    Raises:
        ModuleNotFoundError: the package does not exist.
    """
    found = importlib.util.find_spec(package)
    if found is None or found.submodule_search_locations is None:
        raise ModuleNotFoundError(f"no package {package}")
    inside = pkgutil.walk_packages(found.submodule_search_locations, f"{package}.")
    return [package, *sorted(module.name for module in inside if not module.name.endswith("__main__"))]


def write_reference(modules: Iterable[str], folder: Path) -> None:
    """Write a page for each module, an index and a search to ``folder``; the pages load no external resources."""
    pdoc.render.configure(docformat="google", footer_text="continuum", search=True, show_source=True)
    with warnings.catch_warnings():
        # generated constructors of dataclass and NamedTuple refer to types that only their modules import
        warnings.filterwarnings("ignore", r"Error parsing type annotation", UserWarning)
        # every module is given explicitly and found in its package again; each page is written once nevertheless
        warnings.filterwarnings("ignore", r"The module specification .* has already been added", UserWarning)
        pdoc.pdoc(*modules, output_directory=folder)
