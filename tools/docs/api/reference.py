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
    """Dotted names of a package and of all modules in it, also where an ``__all__`` above names their contents alone.

    Raises:
        ModuleNotFoundError: no such package.
    """
    found = importlib.util.find_spec(package)
    if found is None or found.submodule_search_locations is None:
        raise ModuleNotFoundError(f"no package {package}")
    inside = pkgutil.walk_packages(found.submodule_search_locations, f"{package}.")
    return [package, *sorted(module.name for module in inside if not module.name.endswith("__main__"))]


def write_reference(modules: Iterable[str], folder: Path) -> None:
    """Write a page for each module, an index and a search into ``folder``; the pages load nothing from elsewhere."""
    pdoc.render.configure(docformat="google", footer_text="continuum", search=True, show_source=True)
    with warnings.catch_warnings():
        # constructors that dataclass and NamedTuple generate name types that their module imports for itself
        warnings.filterwarnings("ignore", r"Error parsing type annotation", UserWarning)
        # every module is named, and so are packages, which are walked: pages are made once all the same
        warnings.filterwarnings("ignore", r"The module specification .* has already been added", UserWarning)
        pdoc.pdoc(*modules, output_directory=folder)
