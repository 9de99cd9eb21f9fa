"""Figures of a page are put in the place of older ones, and what stands around them stays."""

from pathlib import Path

from tools.markdown import replace_between

BEGIN, END = "<!-- begin -->", "<!-- end -->"


def test_only_what_stands_between_is_replaced(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(f"# Page\n\n{BEGIN}\n\nold\n\n{END}\n\nMore.\n", encoding="utf-8")
    for text in ("new", "newer"):
        replace_between(page, BEGIN, END, text)
        assert page.read_text(encoding="utf-8") == f"# Page\n\n{BEGIN}\n\n{text}\n\n{END}\n\nMore.\n"
