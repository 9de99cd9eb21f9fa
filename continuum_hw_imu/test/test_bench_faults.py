"""Faults of the line, orders and their language, hands and clocks of the emulator, each by itself."""

import numpy as np
import pytest
from bench_frames import FRAMES
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.live.stepper import Interval
from continuum.errors import InvalidValueError
from continuum_hw_imu.emulator.actuators import Actuators
from continuum_hw_imu.emulator.hand import Hand
from continuum_hw_imu.emulator.line_faults import FaultyLine, LineFault, LineFaultKind, pieces_of
from continuum_hw_imu.emulator.line_queue import LineQueue
from continuum_hw_imu.emulator.orders import ACTIONS, Order, read_order, read_orders
from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.decoder import Decoder
from continuum_hw_imu.protocol.frame import Frame

PIECE = b"\0abcdefgh\0"


def line(kind: str, share: float = 1.0, until: float = 10.0, by: float = 0.0, size: int = 5) -> FaultyLine:
    faulty = FaultyLine(np.random.default_rng(1))
    faulty.add(LineFault(LineFaultKind(kind), share, until, by, size))
    return faulty


@pytest.mark.parametrize(("kind", "expected"), [("lose", []), ("repeat", [(0.0, PIECE)] * 2), ("late", [(0.3, PIECE)])])
def test_faults_do_what_they_are_called(kind, expected):
    assert line(kind, by=0.3).passed(PIECE, 0.0) == expected


def test_nothing_is_left_of_a_damaged_frame():
    """But for one in 65,536 whose checksum fits by chance."""
    faulty, decoder = line("damage"), Decoder.of_device()
    for k in range(2000):
        ((_, damaged),) = faulty.passed(Frame(k, 0, m.Claim(k)).encode(), 0.0)
        assert decoder.feed(damaged + bytes(1)) == []
    assert faulty.hit == 2000


def test_noise_stands_before_the_frame():
    for _ in range(50):
        ((_, piece),) = line("noise", size=5).passed(PIECE, 0.0)
        assert piece.endswith(PIECE)
        assert 1 <= len(piece) - len(PIECE) <= 5


def test_a_share_of_the_frames_is_hit_until_the_fault_ends():
    faulty = line("lose", share=0.3)
    lost = sum(not faulty.passed(PIECE, 1.0) for _ in range(2000))
    assert lost == pytest.approx(600, abs=100)
    assert faulty.passed(PIECE, 10.0) == [(0.0, PIECE)]


def test_faults_add_up():
    faulty = line("repeat")
    faulty.add(LineFault(LineFaultKind.LATE, 1.0, 10.0, by=0.1))
    assert faulty.passed(PIECE, 0.0) == [(0.1, PIECE)] * 2
    faulty.clear()
    assert faulty.passed(PIECE, 0.0) == [(0.0, PIECE)]


@given(st.lists(FRAMES, max_size=4), st.binary(max_size=20))
def test_bytes_are_cut_between_frames_and_none_is_lost(frames, rest):
    data = b"".join(frame.encode() for frame in frames) + rest
    pieces = pieces_of(data)
    assert b"".join(pieces) == data
    assert pieces[: len(frames)] == [frame.encode() for frame in frames]


def test_a_slow_line_takes_its_time_and_keeps_order():
    queue = LineQueue(baud=1000.0)
    queue.put(0.0, b"x" * 10)
    queue.put(0.0, b"y" * 10, delay=1.0)
    queue.put(0.05, b"z" * 10)
    assert queue.next == pytest.approx(0.1)
    assert queue.due(0.099) == []
    assert queue.due(0.29) == [b"x" * 10]
    assert queue.due(0.31) == [b"z" * 10]
    assert queue.due(1.3) == [b"y" * 10]
    assert queue.next is None


def test_what_a_line_cannot_carry_is_dropped_and_a_cut_frees_it():
    queue = LineQueue(baud=1000.0)
    for _ in range(100):
        queue.put(0.0, b"x" * 100)  # a second each
    assert queue.dropped == 98
    assert queue.due(10.0) == [b"x" * 100] * 2
    queue.clear()
    queue.put(0.0, b"y" * 10)
    assert queue.next == pytest.approx(0.1)


def test_an_order_is_read_with_its_defaults():
    assert read_order("at 2.5 lose share=0.2 way=both") == Order("lose", {"share": 0.2, "for": 1.0}, "both", 2.5)
    assert read_order("drop sensor=3 for=2").numbers == {"sensor": 3.0, "for": 2.0}
    assert read_order("reboot") == Order("reboot", {})


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("explode", "order"),
        ("", "order"),
        ("at", "at"),
        ("at x lose", "at"),
        ("at -1 lose", "at"),
        ("lose share=2", "share"),
        ("lose share=nan", "share"),
        ("lose share", "share"),
        ("lose way=left", "way"),
        ("lose color=1", "share, for, way"),
        ("unplug way=up", "for"),
        ("drop", "sensor"),
        ("drift ppm=inf", "ppm"),
    ],
)
def test_what_is_no_order_is_refused_by_name(text, problem):
    with pytest.raises(InvalidValueError, match=problem):
        read_order(text)


WORDS = st.lists(st.sampled_from([*ACTIONS, "at", "1", "for=1", "sensor=1", "x=", "="])).map(" ".join)


@given(st.text(max_size=60) | WORDS)
def test_any_text_is_an_order_or_refused(text):
    try:
        order = read_order(text)
    except InvalidValueError:
        return
    assert order.action in ACTIONS
    assert order.numbers.keys() == ACTIONS[order.action].keys()


def test_a_script_is_sorted_and_may_have_remarks():
    orders = read_orders(["# what comes", "", "at 5 reboot  # late", "clear", "at 1 freeze"])
    assert [(order.at, order.action) for order in orders] == [(0.0, "clear"), (1.0, "freeze"), (5.0, "reboot")]


def test_a_hand_moves_smoothly_from_here_to_there():
    hand = Hand(10.0, np.array([0.1, 0.0]), np.array([0.5, -0.2]), over=2.0, hold=1.0)
    times = np.linspace(10.0, 12.0, 201)
    angles, rates = (np.array(part) for part in zip(*(hand.motion(t) for t in times), strict=True))
    np.testing.assert_allclose(angles[[0, -1]], [hand.start, hand.goal])
    np.testing.assert_allclose(rates[[0, -1]], 0.0, atol=1e-12)
    np.testing.assert_allclose(np.gradient(angles, times, axis=0)[1:-1], rates[1:-1], atol=1e-3)
    assert hand.motion(12.9)[0].tolist() == hand.goal.tolist()
    assert hand.end == 13.0


def test_actuators_follow_with_their_lag():
    actuators = Actuators(1, 0.05, 0.0, np.random.default_rng(0))
    step = Interval(0.001, np.zeros(1), np.array([10.0]))
    reached = [actuators.follow(step) for _ in range(100)]
    expected = 10.0 * (1 - np.exp(-np.arange(1, 101) / 50))
    np.testing.assert_allclose([now.after[0] for now in reached], expected)
    assert reached[50].before == reached[49].after
    np.testing.assert_array_equal(actuators.measured(), actuators.tension)


def test_load_cells_are_noisy():
    actuators = Actuators(2, 0.0, 0.05, np.random.default_rng(0))
    assert np.std([actuators.measured() for _ in range(2000)]) == pytest.approx(0.05, rel=0.1)


@pytest.mark.parametrize("kind", list(LineFaultKind))
def test_the_decoder_lives_with_every_fault(kind):
    faulty, decoder = line(kind, share=0.5, by=0.1, size=400), Decoder.of_device()
    sent = [m.Claim(k) for k in range(300)]
    found = [
        frame.message
        for k, message in enumerate(sent)
        for _, piece in faulty.passed(Frame(k, 0, message).encode(), 0.0)
        for frame in decoder.feed(piece)
    ]
    assert set(found) <= set(sent)
    assert len(set(found)) >= (100 if kind in ("lose", "damage") else 300)
