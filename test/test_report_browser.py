"""The page of a diagnosis in a real browser: no wider than a phone, legible there, and in both modes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser import headless_browser
from diagnosis_by_hand import cause, detectable, diagnosis

from continuum.discovery.decision import Kind
from continuum.discovery.report import write_report
from continuum.dynamics.effect_lookup import effect_names

pytestmark = pytest.mark.slow

PHONE, SCREEN = 390, 1280
_TEXT_SIZES = "[...document.querySelectorAll('main svg text')].map(t => t.getBoundingClientRect().height)"
_OPEN = "document.querySelectorAll('details').forEach(one => one.open = true)"
_COLOURS = """[...document.querySelectorAll('main p, main svg path, main svg text, main td')].map(one => {
  const style = getComputedStyle(one);
  return one.tagName == 'path' ? style.stroke : one.tagName == 'text' ? style.fill : style.color;
})"""
_PAPER = "getComputedStyle(document.body).backgroundColor"
_LEAST_LETTERS = 10.0  # px, of a line of text with ascenders: a phone's own small print
_LEAST_CONTRAST = 1.25  # of the grid, which is meant to be faint


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    with headless_browser() as browser:
        yield browser


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """With all that a page may have."""
    names = ["a_recording_with_a_name_that_is_much_longer_than_a_phone_is_wide_" * 2, "run 2"]
    power = [detectable(name) for name in effect_names()]
    sets = [cause("angle_offset", 0, 1, 2), cause("tip_payload")], [cause("inertia", 2)]
    path = tmp_path_factory.mktemp("report") / "page.html"
    write_report(diagnosis(Kind.AMBIGUOUS, *sets, names=names, after=3.0, power=power), path, "Made by hand.")
    return path


@pytest.mark.parametrize("mode", ["light", "dark"])
@pytest.mark.parametrize("width", [PHONE, SCREEN])
def test_the_page_is_no_wider_than_its_window_and_legible(chromium: Any, page: Path, width: int, mode: str) -> None:
    tab = chromium.new_page(viewport={"width": width, "height": 844}, color_scheme=mode)
    tab.goto(page.as_uri())
    for _ in range(2):
        assert tab.evaluate("document.documentElement.scrollWidth") == width
        assert min(tab.evaluate(_TEXT_SIZES)) >= _LEAST_LETTERS
        tab.evaluate(_OPEN)
    paper = tab.evaluate(_PAPER)
    assert all(contrast(colour, paper) > _LEAST_CONTRAST for colour in tab.evaluate(_COLOURS))
    assert (luminance(paper) < 0.1) == (mode == "dark")
    tab.close()


def luminance(colour: str) -> float:
    """Relative, of "rgb(r, g, b)" (WCAG 2.2)."""
    parts = [float(one) / 255 for one in colour.partition("(")[2].rstrip(")").split(",")[:3]]
    linear = [x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Of two colours, 1 to 21 (WCAG 2.2)."""
    darker, lighter = sorted((luminance(one), luminance(other)))
    return (lighter + 0.05) / (darker + 0.05)
