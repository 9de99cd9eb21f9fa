"""A headless browser for tests, and the page of `continuum view` in it."""

from __future__ import annotations

import io
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from harness import wait_until
from PIL import Image

from tools.setup.browser.place import EXTRA, chromium, environment

PICTURES = Path(__file__).resolve().parent.parent / "out" / "test_artefacts" / "viewer"

_SWITCHES = (
    "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
    "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
)  # fmt: skip
"""Root may run it; drawing needs no graphics card; it asks nobody for updates."""


_SCENE = {"x": 330, "y": 0, "width": 530, "height": 720}
"""What is to be seen of the scene, without panels."""


@contextmanager
def headless_browser() -> Iterator[Any]:
    """Chromium driven by Playwright; the test is skipped where one of them is missing."""
    program = chromium()
    if program is None or not (EXTRA / "playwright").is_dir():
        pytest.skip(f"no {'Chromium' if program is None else 'Playwright'}: `make browser` fetches what can be had")
    sys.path.append(str(EXTRA))
    try:
        from playwright.sync_api import sync_playwright

        with sync_playwright() as driver:
            browser = driver.chromium.launch(
                executable_path=program.path, args=list(_SWITCHES), env=environment(program), timeout=120_000
            )
            yield browser
            browser.close()
    finally:
        sys.path.remove(str(EXTRA))


@contextmanager
def view(*arguments: str) -> Iterator[str]:
    """`continuum view` on a free port; gives its address."""
    command = ["continuum", "view", *arguments, "--port", "0", "--no-browser"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        line = next((line for line in process.stdout if line.startswith("open http")), None)
        assert line is not None, process.stderr.read()
        yield line.split()[1]
        process.terminate()
        assert process.wait(30) == 0
        assert process.stderr.read() == ""
    finally:
        process.kill()
        process.wait()
        process.stdout.close()
        process.stderr.close()


class ViewedPage:
    """One tab of the browser with the viewer's page in it.

    Args:
        browser: Playwright's.
        address: of the page.
    """

    def __init__(self, browser: Any, address: str) -> None:
        self.requests: list[str] = []
        self.errors: list[str] = []
        self.tab = browser.new_page(viewport={"width": 1200, "height": 720}, device_scale_factor=0.5)
        self.tab.set_default_timeout(120_000)
        self.tab.on("request", lambda request: self.requests.append(request.url))
        self.tab.on("websocket", lambda socket: self.requests.append(socket.url))
        self.tab.on("pageerror", lambda error: self.errors.append(str(error)))
        self.tab.goto(address)
        self.tab.get_by_text("continuum", exact=True).wait_for()
        note = self.tab.get_by_text("Software WebGL rendering detected")
        note.wait_for()
        self.tab.locator(".mantine-Notification-closeButton").click()
        note.wait_for(state="detached")

    def pixels(self) -> Any:
        """The scene without the panel and without notes, (height, width, 3) from 0 to 255, as integers."""
        picture = Image.open(io.BytesIO(self.tab.screenshot(clip=_SCENE, scale="css")))
        return np.asarray(picture.convert("RGB")).astype(int)

    def settled(self) -> Any:
        """As `pixels`, once the scene stands still: a machine without a graphics card draws late."""
        seen = [self.pixels()]

        def still() -> bool:
            self.tab.wait_for_timeout(400)
            seen.append(self.pixels())
            return bool(np.array_equal(seen[-1], seen[-2]))

        self.wait_for(still, "a scene that stands still")
        return seen[-1]

    def uppermost(self, mask: Any) -> tuple[float, float]:
        """Where on the tab the upper end of a mask of `pixels` is."""
        rows, columns = np.nonzero(mask)
        top = rows < rows.min() + 12
        return _SCENE["x"] + float(columns[top].mean()), float(rows[top].mean())

    def keep(self, name: str) -> None:
        """Keep a screenshot among the tests' artefacts."""
        PICTURES.mkdir(parents=True, exist_ok=True)
        self.tab.screenshot(path=PICTURES / f"{name}.png")

    def number(self, label: str, which: int = 0) -> Any:
        """The number input of the slider with this label."""
        row = self.tab.get_by_text(label, exact=True).nth(which).locator("xpath=ancestor::*[.//input][1]")
        return row.locator("input").last

    def set_number(self, label: str, value: float, which: int = 0) -> None:
        """Type a number into the input of a slider."""
        field = self.number(label, which)
        field.fill(f"{value:g}")
        field.press("Enter")

    def wait_for(self, condition: Any, what: str) -> None:
        """Wait while the page goes on."""
        wait_until(lambda: (self.tab.wait_for_timeout(50), condition())[1], what, timeout=120.0, pause=0.0)
