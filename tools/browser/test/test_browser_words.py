"""`make browser` says what the tests will use."""

from pathlib import Path

import pytest

from tools.browser import __main__ as command
from tools.browser.place import Chromium


@pytest.fixture
def program(tmp_path: Path) -> Path:
    file = tmp_path / "chromium"
    file.write_text("#!/bin/sh\necho A browser 1.2.3 $LD_LIBRARY_PATH\n", encoding="utf-8")
    file.chmod(0o755)
    return file


def test_browser_and_playwright_are_named(
    program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    info = tmp_path / "playwright-9.8.7.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: playwright\nVersion: 9.8.7\n", encoding="utf-8")
    monkeypatch.setattr(command, "EXTRA", tmp_path)
    monkeypatch.setattr(command, "chromium", lambda: Chromium(program, (Path("/libraries"),)))
    monkeypatch.chdir(tmp_path.parent)
    assert command.main() == 0
    assert capsys.readouterr().out.splitlines() == [
        f"Chromium: {program} (A browser 1.2.3 /libraries)",
        f"Playwright: {tmp_path.name} (9.8.7)",
    ]


def test_a_browser_that_does_not_run_is_told(program: Path) -> None:
    program.write_text("#!/bin/sh\nexit 3\n", encoding="utf-8")
    assert "exit code 3" in command.version(Chromium(program))
    assert "does not run" in command.version(Chromium(program.parent / "none"))
