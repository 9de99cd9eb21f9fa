"""The viewer's page in a real browser: it draws, sliders and target move the arm, a recording is scrubbed."""

from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest
from browser import ViewedPage, headless_browser, view

pytestmark = pytest.mark.slow


def swinging(file: Path) -> Path:
    """A recording of five joints that swing for 1.6 s, and rest."""
    times = np.arange(0.0, 1.6, 1 / 120)
    angle = 18.0 * np.cos(10.0 * times) * np.exp(-3.0 * times)
    header = ",".join(["t_s", *(f"q{i}_deg" for i in range(1, 6))])
    np.savetxt(file, np.column_stack([times, *[angle] * 5]), delimiter=",", header=header, comments="")
    return file


def orange(pixels: np.ndarray) -> np.ndarray:
    """Where the discs of the first section are."""
    red, green, blue = np.moveaxis(pixels, -1, 0)
    return (red > 120) & (red - blue > 60) & (red > green + 20) & (green > blue)


def blue(pixels: np.ndarray) -> np.ndarray:
    """Where the target's upright arrow is, and below it other things."""
    red, green, blue = np.moveaxis(pixels, -1, 0)
    return (blue > 180) & (blue - red > 100) & (blue > green + 30)


@pytest.fixture(scope="class")
def moved_by_hand():
    with view() as address, headless_browser() as browser:
        page = ViewedPage(browser, address)
        page.wait_for(lambda: orange(page.pixels()).sum() > 500, "the arm")
        yield page
        page.tab.close()


class TestMovedByHand:
    """One page for these tests, closed before the next: Chromium starves the page that is not in front."""

    def test_nothing_comes_from_elsewhere(self, moved_by_hand):
        hosts = {urlsplit(url.removeprefix("blob:")).hostname for url in moved_by_hand.requests if url[:5] != "data:"}
        assert hosts == {"127.0.0.1"}
        assert moved_by_hand.errors == []

    def test_arm_moves_with_a_slider(self, moved_by_hand):
        page = moved_by_hand
        before = page.settled()
        page.keep("straight")
        page.set_number("theta [deg]", 80.0)
        page.wait_for(lambda: (orange(page.pixels()) ^ orange(before)).sum() > 0.2 * orange(before).sum(), "a bent arm")
        page.set_number("theta [deg]", 60.0, which=1)
        page.set_number("phi [deg]", 120.0, which=1)
        page.tab.get_by_text("The target follows the sliders.").wait_for()
        page.settled()
        page.keep("bent")

    def test_a_dragged_target_is_reached(self, moved_by_hand):
        page = moved_by_hand
        for number in range(3):
            page.set_number("theta [deg]", 0.0, which=number)
            page.set_number("phi [deg]", 0.0, which=number)
        handle = page.uppermost(blue(page.settled()))
        page.tab.mouse.move(*handle)
        page.tab.wait_for_timeout(500)  # the page has to see what is under the mouse before it is pressed
        page.tab.mouse.down()
        for step in range(1, 21):
            page.tab.mouse.move(handle[0], handle[1] + 6 * step)
            page.tab.wait_for_timeout(50)
        page.tab.mouse.up()
        words = page.tab.get_by_text("Target reached; the tip is 0.00")
        words.wait_for()
        assert float(page.number("theta [deg]", 2).input_value()) > 0.0
        page.settled()
        page.keep("target")


def test_playback_scrubs(tmp_path):
    with view(str(swinging(tmp_path / "run.csv"))) as address, headless_browser() as browser:
        page = ViewedPage(browser, address)
        time = page.number("time [s]")
        page.tab.get_by_label("Repeat").uncheck()
        page.wait_for(lambda: float(time.input_value()) >= 1.5, "the end of the recording")
        end = page.settled()
        page.keep("recording_end")
        page.set_number("time [s]", 0.0)
        page.wait_for(lambda: (orange(page.pixels()) ^ orange(end)).sum() > 0.2 * orange(end).sum(), "the beginning")
        page.settled()
        page.keep("recording_begin")
        page.tab.mouse.click(600, 100)  # keys are of the page, not of the input that was typed into
        for key, sample in (("l", 1), ("l", 2), ("j", 1)):
            page.tab.keyboard.press(key)
            page.wait_for(lambda at=sample / 120: abs(float(time.input_value()) - at) < 0.006, f"sample {sample}")
        page.tab.keyboard.press("Space")
        page.wait_for(lambda: float(time.input_value()) > 0.1, "time that goes on")
        page.tab.get_by_role("button", name="Pause").click()
        page.tab.get_by_role("button", name="Play").wait_for()
        page.tab.close()
