"""The site's source: every page is in the navigation, and every link leads to what the site has."""

import re
from pathlib import Path

import pytest

from tools.docs.site.source import DOCS, GENERATED, REFERENCE, ROOT, examples, navigation, within_site

PAGES = [ROOT / "README.md", *sorted(DOCS.glob("*.md"))]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_stay_within_the_site(page: Path) -> None:
    text = within_site(page.read_text(encoding="utf-8"), page.parent)
    assert text.count("\n") == page.read_text(encoding="utf-8").count("\n")
    for address in re.findall(r"\]\(([^)#\s]+)[^)]*\)", re.sub(r"`[^`\n]*`", "", text)):
        assert "://" in address or address in GENERATED.values() or (DOCS / address).exists(), address


def test_the_navigation_has_every_page_once() -> None:
    found = [page for part in navigation() for pages in part.values() for page in _pages(pages)]
    expected = [*(page.name for page in DOCS.glob("*.md")), *GENERATED.values(), REFERENCE]
    assert sorted(found) == sorted(expected)


def _pages(part: str | list[dict[str, str]]) -> list[str]:
    return [part] if isinstance(part, str) else [page for one in part for page in one.values()]


def test_every_example_is_on_the_page_of_examples() -> None:
    text = examples()
    for script in (ROOT / "examples").glob("*.py"):
        assert script.read_text(encoding="utf-8").strip() in text
