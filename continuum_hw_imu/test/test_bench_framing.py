"""Stuffing and frames: what is written is read, in whatever pieces and beside whatever garbage it comes."""

import pytest
from bench_frames import FRAMES, OF_DEVICE, OF_HOST, U16, U32, cut_up
from hypothesis import given
from hypothesis import strategies as st

from continuum.errors import InvalidValueError
from continuum_hw_imu.protocol import checksum, cobs
from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.decoder import Decoder, Garbage
from continuum_hw_imu.protocol.frame import HEADER, LONGEST_CODED, VERSION, Frame, FrameWriter

DATA = st.binary(max_size=1200) | st.lists(st.binary(min_size=250, max_size=260), max_size=4).map(b"\1".join)
EVERY_TYPE = (*m.OF_DEVICE, *m.OF_HOST)


def both() -> Decoder:
    return Decoder(EVERY_TYPE)


def on_the_line(content: bytes) -> bytes:
    """A frame of any content, with a right check."""
    return b"\0" + cobs.encoded(checksum.sealed(content)) + b"\0"


@given(DATA)
def test_stuffing_round_trip_without_zeros_and_with_little_more(data):
    coded = cobs.encoded(data)
    assert cobs.decoded(coded) == data
    assert 0 not in coded
    assert len(data) < len(coded) <= len(data) + 1 + len(data) // 254


@pytest.mark.parametrize(
    ("data", "coded"),
    [  # the algorithm worked out by hand
        ("", "01"),
        ("00", "01 01"),
        ("11 22 00 33", "03 11 22 02 33"),
        ("11 00 00 00", "02 11 01 01 01"),
        ("01" * 254, "ff" + "01" * 254),
        ("01" * 255, "ff" + "01" * 254 + "02 01"),
        ("00" + "01" * 254, "01 ff" + "01" * 254),
        ("01" * 254 + "00", "ff" + "01" * 254 + "01 01"),
    ],
)
def test_stuffing_by_hand(data, coded):
    assert cobs.encoded(bytes.fromhex(data)) == bytes.fromhex(coded)
    assert cobs.decoded(bytes.fromhex(coded)) == bytes.fromhex(data)


@given(st.binary(max_size=600))
def test_any_bytes_are_unstuffed_or_refused(coded):
    data = cobs.decoded(coded)
    assert data is None or (0 not in coded and len(data) < len(coded))


def test_checksum_is_the_one_that_every_language_has():
    assert checksum.sealed(b"123456789")[9:] == bytes.fromhex("26 39 f4 cb")  # CRC-32's check value, little-endian


@given(U16, U32, OF_DEVICE | OF_HOST)
def test_every_message_comes_out_as_it_went_in(sequence, time, message):
    frame = Frame(sequence, time, message)
    coded = frame.encode()
    assert coded[0] == coded[-1] == 0
    assert 0 not in coded[1:-1]
    assert both().feed(coded) == [frame]


@given(st.data(), st.lists(FRAMES, min_size=1, max_size=5))
def test_pieces_of_any_size_give_the_same_frames(data, frames):
    decoder = both()
    pieces = data.draw(cut_up(b"".join(frame.encode() for frame in frames)))
    found = [frame for piece in pieces for frame in decoder.feed(piece)]
    assert found == frames
    assert decoder.good == len(frames)
    assert not decoder.errors


@given(st.data(), st.lists(st.binary(max_size=700), min_size=2, max_size=5), st.lists(FRAMES, min_size=5, max_size=5))
def test_garbage_costs_no_frame_next_to_it(data, noise, frames):
    decoder = both()
    line = b"".join(rubbish + frame.encode() for rubbish, frame in zip(noise, frames, strict=False))
    found = [frame for piece in data.draw(cut_up(line)) for frame in decoder.feed(piece)]
    assert found == frames[: len(noise)]
    stretches = [stretch for rubbish in noise for stretch in rubbish.split(b"\0") if stretch]
    assert decoder.refused == len(stretches)


@given(FRAMES, st.data())
def test_damage_is_found(frame, data):
    coded = bytearray(frame.encode()[1:-1])
    for _ in range(data.draw(st.integers(1, 3))):
        coded[data.draw(st.integers(0, len(coded) - 1))] ^= 1 << data.draw(st.integers(0, 7))
    hurt = both().feed(b"\0" + bytes(coded) + b"\0")
    assert hurt in ([], [frame])  # two of the three may have taken each other back


@given(st.lists(st.binary(max_size=3000), max_size=20))
def test_memory_is_bounded_and_nothing_raises(pieces):
    for decoder in (Decoder.of_host(), Decoder.of_device()):
        for piece in pieces:
            decoder.feed(piece)
            assert decoder.waiting <= LONGEST_CODED


def test_a_stretch_that_never_ends_is_one_error():
    decoder = both()
    for _ in range(1000):
        decoder.feed(b"\1" * 100)
        assert decoder.waiting <= LONGEST_CODED
    assert decoder.errors == {Garbage.TOO_LONG: 1}
    frame = Frame(1, 2, m.Stop())
    assert decoder.feed(frame.encode()) == [frame]
    assert decoder.errors == {Garbage.TOO_LONG: 1}


@pytest.mark.parametrize(
    ("line", "kind"),
    [
        (b"\0\5\1\0", Garbage.NOT_COBS),
        (b"\0" + b"\1" * 256 + b"\0", Garbage.TOO_LONG),
        (b"\0\3\1\1\0", Garbage.TOO_SHORT),
        (b"\0" + cobs.encoded(b"\1" * 20) + b"\0", Garbage.CHECKSUM),
        (on_the_line(HEADER.pack(VERSION + 1, 0x86, 0, 0)), Garbage.VERSION),
        (on_the_line(HEADER.pack(VERSION, 0x7E, 0, 0)), Garbage.UNKNOWN_TYPE),
        (on_the_line(HEADER.pack(VERSION, 0x86, 0, 0) + b"x"), Garbage.PAYLOAD),
    ],
)
def test_each_kind_of_garbage_is_called_by_its_name(line, kind):
    decoder = both()
    assert decoder.feed(line) == []
    assert decoder.errors == {kind: 1}


def test_another_version_is_reported():
    decoder = both()
    decoder.feed(on_the_line(HEADER.pack(9, 0x86, 0, 0)))
    assert decoder.other_version == 9


@given(st.sampled_from(EVERY_TYPE), st.binary(max_size=250))
def test_a_payload_with_a_right_check_is_read_or_counted_and_what_is_read_can_be_written(kind, payload):
    decoder = both()
    frames = decoder.feed(on_the_line(HEADER.pack(VERSION, kind.TYPE, 5, 6) + payload))
    if frames:
        assert Decoder(EVERY_TYPE).feed(frames[0].encode()) == frames
    assert decoder.good + decoder.errors[Garbage.PAYLOAD] + decoder.errors[Garbage.TOO_LONG] == 1


def test_each_end_hears_the_other_alone():
    request, answer = Frame(0, 0, m.Stop()).encode(), Frame(0, 0, m.Ack(0, 0x86, m.Result.DONE)).encode()
    assert len(Decoder.of_device().feed(request + answer)) == 1
    assert len(Decoder.of_host().feed(request + answer)) == 1


def test_frames_are_numbered_in_a_row_and_round():
    writer, decoder = FrameWriter(), both()
    writer.sequence = 0xFFFE
    frames = [frame for _ in range(4) for frame in decoder.feed(writer.write(m.Stop(), 1 << 33))]
    assert [frame.sequence for frame in frames] == [0xFFFE, 0xFFFF, 0, 1]
    assert {frame.time for frame in frames} == {0}


@pytest.mark.parametrize("tension", [-0.01, 400.0, float("nan"), float("inf")])
def test_tensions_that_do_not_exist_on_the_line_are_not_written(tension):
    with pytest.raises(InvalidValueError, match="tension"):
        m.SetTension(1, 2, (1.0, tension)).encode()
