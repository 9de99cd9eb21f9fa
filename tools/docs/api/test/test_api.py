"""The reference from docstrings: every module has its page, links lead somewhere, nothing is loaded from elsewhere."""

from pathlib import Path

import pytest

from tools.docs.api.links import problems
from tools.docs.api.reference import modules_of, write_reference

ROOT = Path(__file__).resolve().parents[4]

PART = "continuum.discovery.report"
"""Small, and its functions are hidden behind an ``__all__``. `make api` checks the whole library, in half a minute."""


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("api")
    write_reference([*modules_of(PART), "continuum.arm"], folder)
    return folder


def test_every_module_of_the_library_is_found() -> None:
    package = ROOT / "continuum"
    files = [path.relative_to(package).with_suffix("") for path in (package / "continuum").rglob("*.py")]
    there = {".".join(path.parts).removesuffix(".__init__") for path in files}
    assert set(modules_of("continuum")) == there


def test_every_module_has_a_page(reference: Path) -> None:
    pages = {".".join(path.relative_to(reference).with_suffix("").parts) for path in reference.rglob("*.html")}
    assert {*modules_of(PART), "continuum.arm", "index"} <= pages


def test_links_lead_somewhere_and_nothing_is_loaded_from_elsewhere(reference: Path) -> None:
    assert problems(reference) == []


@pytest.mark.parametrize(
    ("page", "problem"),
    [
        ('<a href="gone.html">x</a>', "a.html: gone.html leads nowhere"),
        ('<a href="b.html#gone">x</a>', "a.html: b.html#gone leads nowhere"),
        ('<img src="gone.png">', "a.html: gone.png leads nowhere"),
        ('<script src="https://example.org/x.js"></script>', "a.html loads https://example.org/x.js"),
        ("<style>@import 'https://example.org/x.css';</style>", "a.html loads https://example.org/x.css"),
        ("<p style=\"background: url('https://example.org/x.png')\">", "a.html loads https://example.org/x.png"),
        ('<a href="b.html#there">x</a><a href="b.html">x</a><a id="here" href="#here">x</a>', None),
        ('<a href="https://example.org">x</a><a href="b.html#a%20b">x</a>', None),
        ("<script>const link = '<a href=\"gone.html\">';</script>", None),
        ("<style>p { background: url(data:image/png;base64,AA//BB) }</style>", None),
    ],
)
def test_a_bad_link_is_reported(tmp_path: Path, page: str, problem: str | None) -> None:
    (tmp_path / "a.html").write_text(page, encoding="utf-8")
    (tmp_path / "b.html").write_text('<p id="there"></p><p id="a b"></p>', encoding="utf-8")
    assert problems(tmp_path) == ([problem] if problem else [])
