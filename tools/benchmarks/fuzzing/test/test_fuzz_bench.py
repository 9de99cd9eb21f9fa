"""The fuzzing itself: it reaches every kind of garbage, and sees parsers that are broken."""

import numpy as np
import pytest

from continuum_hw_imu.protocol import checksum, decoder
from tools.benchmarks.fuzzing.campaign import LIMITS, Tally, run
from tools.benchmarks.fuzzing.line import WAYS

pytestmark = pytest.mark.slow

SIZE = 60_000


def tally(way: str, size: int = SIZE) -> Tally:
    return run(way, WAYS[way](np.random.default_rng(1)), size)


@pytest.mark.parametrize("way", WAYS)
def test_parsers_stand_it(way):
    found = tally(way)
    assert found.size >= SIZE
    assert found.never_sent == 0
    assert found.waiting <= 255
    assert found.memory < 1 << 20
    assert sum(found.refused.values()) > 20
    assert found.largest_tension <= LIMITS.max_tension


def test_together_the_ways_reach_everything():
    found = [tally(way) for way in WAYS]
    kinds = {kind for one in found for kind in one.refused}
    assert kinds == set(decoder.Garbage) - {decoder.Garbage.VERSION}  # of another version nothing is ever sealed
    assert [one.accepted > 0 for one in found] == [False, False, True, True, True]
    assert 0.0 < found[-1].largest_tension <= LIMITS.max_tension  # stops, obeyed whenever they come, keep it low


def test_a_parser_that_takes_what_has_no_check_is_seen(monkeypatch):
    monkeypatch.setattr(checksum, "opened", lambda body: body[:-4])
    assert tally("sound frames, hurt").never_sent > 0


def test_a_parser_that_raises_is_seen(monkeypatch):
    monkeypatch.setattr(decoder.Decoder, "_frame", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        tally("bytes at random")
