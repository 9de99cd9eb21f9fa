"""Check HTML pages for broken links within their folder and for external resources."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

_LOADED_BY_STYLE = re.compile(r"""(?:url\(|@import)\s*["']?\s*((?:https?:)?//[^"')\s;]+)""", re.IGNORECASE)
_LOADING = {"src", "srcset", "poster", "data"}


class _Page(HTMLParser):
    """Anchors of one page, links that a reader may follow, and addresses that a browser loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = {"", "top"}
        self.links: set[str] = set()
        self.loaded: set[str] = set()
        self._in_style = False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self._in_style = tag == "style"
        for name, value in attributes:
            if value is None:
                continue
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name in _LOADING or (tag == "link" and name == "href"):
                self.loaded.add(value)
            elif name == "href":
                self.links.add(value)
            elif name == "style":
                self.loaded.update(_LOADED_BY_STYLE.findall(value))

    def handle_endtag(self, tag: str) -> None:  # noqa: ARG002  (any tag: styles contain no tags)
        self._in_style = False

    def handle_data(self, data: str) -> None:
        if self._in_style:
            self.loaded.update(_LOADED_BY_STYLE.findall(data))


def problems(folder: Path) -> list[str]:
    """Return one line for every broken link within ``folder``, and for every address that a page loads."""
    pages = {path.resolve(): _Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        name = path.relative_to(folder.resolve())
        found += [f"{name} loads {address}" for address in sorted(page.loaded) if _is_outside(address)]
        inside = {link for link in page.links | page.loaded if not urlsplit(link).scheme and not _is_outside(link)}
        found += [f"{name}: {link} leads nowhere" for link in sorted(inside) if not _is_there(path, link, pages)]
    return found


def _is_outside(address: str) -> bool:
    return bool(urlsplit(address).netloc)


def _is_there(path: Path, link: str, pages: dict[Path, _Page]) -> bool:
    parts = urlsplit(link)
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if target not in pages:
        return target.is_file()
    return unquote(parts.fragment) in pages[target].anchors
