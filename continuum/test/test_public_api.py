"""What the packages name as public is there, and pages and examples use nothing else."""

import importlib
import re
from pathlib import Path

import continuum

LIBRARY = Path(continuum.__file__).parent
ROOT = Path(__file__).resolve().parents[2]
PACKAGES = [one for one in sorted(LIBRARY.rglob("__init__.py")) if "\nPublic:" in one.read_text(encoding="utf-8")]


def public() -> set[str]:
    """Dotted names that the packages' docstrings list."""
    found = set()
    for path in PACKAGES:
        package = ".".join(("continuum", *path.parent.relative_to(LIBRARY).parts))
        listed = path.read_text(encoding="utf-8").partition("\nPublic:")[2].partition('"""')[0]
        found |= {f"{package}.{name}" for name in re.findall(r"`([\w.]+)`", listed)}
    return found


def used() -> set[str]:
    """Dotted names that pages and examples import from the library."""
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("*.md"), *(ROOT / "examples").glob("*.py")]
    lines, found = re.compile(r"^from (continuum(?:\.[\w.]+)?) import (.+)$", re.MULTILINE), set()
    for page in pages:
        for module, names in lines.findall(page.read_text(encoding="utf-8")):
            found |= {f"{module}.{name.partition(' as ')[0].strip()}" for name in names.strip("()").split(",")}
    return found


def test_every_public_name_is_there() -> None:
    assert PACKAGES
    for name in public():
        module, _, attribute = name.rpartition(".")
        assert hasattr(importlib.import_module(module), attribute), name


def test_pages_and_examples_use_public_names_alone() -> None:
    assert used() - public() == set()
