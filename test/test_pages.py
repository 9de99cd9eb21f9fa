"""Links and pictures of README.md and docs/: they lead somewhere, are shown, small, and named with what makes them."""

import re
from pathlib import Path

import pytest
from readme.blocks import outside_of_blocks

from tools.docs.site.source import KINDS

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
INDEX = DOCS / "README.md"
PAGES = [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]
PICTURES = sorted((DOCS / "pictures").iterdir())

LARGEST = 150_000
"""Bytes of a picture."""

each_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))


def text_of(page: Path) -> str:
    """Without code, in which brackets are no links."""
    return re.sub(r"`[^`\n]*`", "", outside_of_blocks(page.read_text(encoding="utf-8")))


def links(page: Path) -> list[str]:
    return re.findall(r"\]\(\s*<?([^)\s>]+)>?[^)]*\)", text_of(page))


def pictures(page: Path) -> list[str]:
    """Addresses of the pictures that a page shows."""
    text = text_of(page)
    return re.findall(r"!\[[^\]]*\]\(([^)\s]+)\)", text) + re.findall(r"""<img[^>]*src=["']([^"']+)""", text)


def anchors(page: Path) -> set[str]:
    """Of a page's headings, as forges make them."""
    headings = re.findall(r"^#+ +(.+)$", outside_of_blocks(page.read_text(encoding="utf-8")), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def leads_nowhere(page: Path, link: str) -> bool:
    address, _, anchor = link.partition("#")
    target = (page.parent / address).resolve() if address else page
    return not target.exists() or bool(anchor and target.suffix == ".md" and anchor not in anchors(target))


def rows(*headings: str) -> dict[str, str]:
    """Of the index's tables under headings: the command of each row, empty where there is none, by the file's name."""
    text = INDEX.read_text(encoding="utf-8")
    table = "".join(text.partition(f"## {heading}\n")[2].partition("\n#")[0] for heading in headings)
    return dict(re.findall(r"^\| \[([\w.-]+)\]\([^)]*\) \|[^|]*\| *(?:`make ([\w-]+)`)? *\|$", table, re.MULTILINE))


def targets() -> set[str]:
    return set(re.findall(r"^([a-z-]+):.*## ", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))


@each_page
def test_links_lead_somewhere(page: Path) -> None:
    inside = [link for link in links(page) if "://" not in link and not link.startswith("mailto:")]
    assert [link for link in inside if leads_nowhere(page, link)] == []


@each_page
def test_pictures_come_from_the_checkout(page: Path) -> None:
    assert [address for address in pictures(page) if "//" in address] == []


def test_every_picture_is_shown() -> None:
    shown = {(page.parent / address).resolve() for page in PAGES for address in pictures(page)}
    assert [path.name for path in PICTURES if path not in shown] == []


@pytest.mark.parametrize("picture", PICTURES, ids=lambda picture: picture.name)
def test_pictures_are_small(picture: Path) -> None:
    assert picture.stat().st_size < LARGEST


def test_the_index_has_every_page_and_picture() -> None:
    assert rows(*KINDS).keys() == {page.name for page in DOCS.glob("*.md")} - {INDEX.name}
    assert rows("Pictures").keys() == {picture.name for picture in PICTURES}


def test_the_index_names_targets_of_make() -> None:
    assert {*rows(*KINDS).values(), *rows("Pictures").values()} - {""} <= targets()
    assert "" not in rows("Pictures").values()


@pytest.mark.parametrize(("page", "target"), [row for row in rows(*KINDS).items() if row[1]])
def test_a_page_names_the_command_that_makes_its_figures(page: str, target: str) -> None:
    assert f"`make {target}`" in (DOCS / page).read_text(encoding="utf-8")


def test_a_page_that_shows_a_picture_is_made_by_its_command() -> None:
    commands = rows(*KINDS)
    shown = {(page.name, Path(address).name) for page in PAGES if page.name in commands for address in pictures(page)}
    assert len(shown) >= 3
    assert {(page, picture) for page, picture in shown if commands[page] != rows("Pictures")[picture]} == set()
