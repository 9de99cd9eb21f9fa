"""The source folder of the site: pages of docs/, front page, examples, and the reference of the library."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path

from tools.docs.api.reference import modules_of, write_reference

ROOT = Path(__file__).resolve().parents[3]
DOCS = ROOT / "docs"
KINDS = ("Tutorials", "How-to guides", "Reference", "Explanation")
"""Headings of docs/README.md, whose tables are the navigation."""

GENERATED = {ROOT / "README.md": "start.md", ROOT / "examples": "examples.md"}
"""Files outside of docs/ that have a page in the site."""

REFERENCE = "api/index.html"
_BESIDES = {"Tutorials": [{"First steps": "start.md"}], "Reference": [{"The library's modules": REFERENCE}]}
"""Entries of the navigation without a row in the index."""

type Navigation = list[dict[str, str | list[dict[str, str]]]]
_LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)")
_PICTURE = re.compile(r"(!\[[^\]]*\]\()([^)\s]+)\)")


def assemble(folder: Path) -> None:
    """Recreate a folder and fill it with the content of the site."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(DOCS, folder)
    for page in folder.glob("*.md"):
        page.write_text(within_site(page.read_text(encoding="utf-8"), DOCS), encoding="utf-8")
    start = within_site((ROOT / "README.md").read_text(encoding="utf-8"), ROOT)
    (folder / GENERATED[ROOT / "README.md"]).write_text(start, encoding="utf-8")
    (folder / GENERATED[ROOT / "examples"]).write_text(examples(), encoding="utf-8")
    write_reference(modules_of("continuum"), (folder / REFERENCE).parent)


def navigation() -> Navigation:
    """Return the tables of docs/README.md by heading, with the title of each page."""
    index = (DOCS / "README.md").read_text(encoding="utf-8")
    found: Navigation = [{"Pages": "README.md"}]
    for kind in KINDS:
        table = index.partition(f"\n## {kind}\n")[2].partition("\n## ")[0]
        pages = [_within(address, DOCS) for address in re.findall(r"^\| \[[^\]]*\]\(([^)]*)\)", table, re.MULTILINE)]
        found.append({kind: [*_BESIDES.get(kind, ()), *({_title(page): page} for page in pages if page is not None)]})
    return found


def examples() -> str:
    """Return a page with the complete scripts of examples/."""
    parts = ["# Examples", "Scripts to copy and change. Run them from the checkout, after `source install/setup.bash`."]
    for script in sorted((ROOT / "examples").glob("*.py")):
        parts += [f"## {script.stem.replace('_', ' ')}", f"`examples/{script.name}`"]
        parts += [f"```python\n{script.read_text(encoding='utf-8').strip()}\n```"]
    return "\n\n".join(parts) + "\n"


def within_site(text: str, folder: Path) -> str:
    """Return a page's text with links relative to the site; links to files outside the site become their names.

    Args:
        text: Markdown.
        folder: folder of the page in the checkout.
    """

    def link(found: re.Match[str]) -> str:
        label, address = found.groups()
        if "://" in address or address.startswith(("#", "mailto:")):
            return found[0]
        path, hash_sign, anchor = address.partition("#")
        page = _within(path, folder)
        if page is not None:
            return f"[{label}]({page}{hash_sign}{anchor})"
        name = os.path.relpath(folder / path, ROOT)
        return label if label.strip("`") in (name, Path(name).name) else f"{label} (`{name}`)"

    def picture(found: re.Match[str]) -> str:
        return f"{found[1]}{os.path.relpath(folder / found[2], DOCS)})"

    return _PICTURE.sub(picture, _LINK.sub(link, text))


def _within(address: str, folder: Path) -> str | None:
    """Return the place in the site of an address in a page of ``folder``; None if the site does not contain it."""
    path = (folder / address).resolve()
    if path in GENERATED:
        return GENERATED[path]
    return os.path.relpath(path, DOCS) if path.is_relative_to(DOCS) else None


def _title(page: str) -> str:
    """Return a page's first heading."""
    text = examples() if page in GENERATED.values() else (DOCS / page).read_text(encoding="utf-8")
    heading = re.search(r"^# (.+)$", text, re.MULTILINE)
    return heading[1] if heading else page
