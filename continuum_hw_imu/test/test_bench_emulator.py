"""The whole emulator on a real pseudo-terminal, in a time of its own: every law without waiting for a clock."""

import csv
import json
import os
import tty
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from continuum.dynamics.model_file import load_model
from continuum_hw_imu.emulator.bench import Bench, BenchSettings
from continuum_hw_imu.emulator.emulator import Emulator, EmulatorSettings
from continuum_hw_imu.emulator.order_book import OrderBook
from continuum_hw_imu.emulator.sensor_model import SensorQuality
from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.decoder import Decoder, Garbage
from continuum_hw_imu.protocol.frame import Frame, FrameWriter
from continuum_hw_imu.protocol.sequence import SequenceTracker

TOKEN = 99
STEP = 1 / 480
WRAP = 1 << 32


class Lab:
    """An emulator, a host at its port, and the time, which begins at 50 s."""

    def __init__(self, folder: Path, **settings: object) -> None:
        self.now = 50.0
        self.bench = Bench(load_model("lamecc_prototype.yaml"), BenchSettings(quality=SensorQuality().perfect()))
        self.truth = folder / "truth.csv"
        chosen = EmulatorSettings(link=folder / "port", truth=self.truth, **settings)
        self.emulator = Emulator(self.bench, chosen, self.now)
        self.book = OrderBook(self.emulator)
        self.link = folder / "port"
        self.port: int | None = None
        self.decoder, self.arrivals, self.writer = Decoder.of_host(), SequenceTracker(), FrameWriter()
        self.frames: list[Frame] = []
        self.newest = 0

    def open(self) -> None:
        self.port = os.open(self.link, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        tty.setraw(self.port)
        self.decoder, self.arrivals = Decoder.of_host(), SequenceTracker()

    def shut(self) -> None:
        if self.port is not None:
            os.close(self.port)
            self.port = None

    def run(self, seconds: float, *, pull: tuple[float, float] | None = None, beat: bool = False) -> list[Frame]:
        """Let time pass; the frames that came."""
        first = len(self.frames)
        for k in range(round(seconds / STEP)):
            self.now += STEP
            if k % 8 == 0 and self.port is not None:
                if pull:
                    self.say(m.SetTension(TOKEN, self.newest, pull))
                if beat:
                    self.say(m.Heartbeat(TOKEN))
            self.book.step(self.now)
            self.emulator.step(self.now)
            self.hear()
        return self.frames[first:]

    def hear(self) -> None:
        try:
            data = b"" if self.port is None else os.read(self.port, 1 << 16)
        except OSError:  # nothing there, or the port has gone
            return
        for frame in self.decoder.feed(data):
            self.arrivals.take(frame.sequence)
            self.frames.append(frame)
            self.newest = frame.time

    def say(self, message: m.Message) -> None:
        try:
            os.write(self.port, self.writer.write(message, 0))
        except OSError:
            return

    def order(self, text: str) -> dict:
        return json.loads(self.book.answer(text, self.now))

    def pulling(self) -> None:
        """Open, claimed, and at 20 N."""
        self.open()
        self.run(0.05)
        self.say(m.Claim(TOKEN))
        self.run(0.4, pull=(20.0, 0.0))
        assert self.bench.controller.guard.set_points.tolist() == [20.0, 0.0]

    def seconds_to_slack(self) -> float:
        start = self.now
        while self.bench.controller.guard.set_points.any():
            self.run(STEP)
            assert self.now < start + 10, "never slack"
        return self.now - start


@pytest.fixture(scope="module")
def _compiled() -> None:
    """The model's equations, which the first arm compiles."""
    Bench(load_model("lamecc_prototype.yaml"), BenchSettings())


@pytest.fixture
def lab(tmp_path: Path, _compiled: None) -> Iterator[Lab]:
    lab = Lab(tmp_path)
    yield lab
    lab.shut()
    lab.emulator.close()


def of(kind: type[m.Message], frames: list[Frame]) -> list[m.Message]:
    return [frame.message for frame in frames if isinstance(frame.message, kind)]


def test_it_says_who_it_is_and_streams_at_its_rate(lab):
    lab.open()
    frames = lab.run(2.0)
    assert isinstance(frames[0].message, m.Hello)
    assert [sensor.link for sensor in frames[0].message.sensors] == [1, 2, 3, 4, 5]
    images = [frame for frame in frames if isinstance(frame.message, m.ImuFrame)]
    assert len(images) in (119, 120)  # the last one may be just due
    gaps = np.diff([frame.time for frame in images])
    assert set(gaps.tolist()) <= {16666, 16667}
    assert np.diff([frame.message.sample for frame in images]) == 1
    assert (lab.arrivals.lost, lab.decoder.refused) == (0, 0)


def test_sums_of_its_rates_are_the_true_angles(lab):
    lab.open()
    lab.run(0.1)
    lab.order("hand bend=90 over=0.5 hold=0.2")
    frames = lab.run(2.0)
    images = [frame for frame in frames if isinstance(frame.message, m.ImuFrame)]
    rates = np.array([frame.message.angular_rates[:, 1] for frame in images])
    links = np.cumsum(rates / 60, axis=0)
    with lab.truth.open() as file:
        rows = {int(row["device_time_us"]): row for row in csv.DictReader(file)}
    true = np.array([[float(rows[frame.time][f"theta_{i}"]) for i in range(1, 6)] for frame in images])
    assert np.degrees(np.abs(true).max()) > 15
    # steps of 0.0625 deg/s, each rounded, over 120 samples of 1/60 s
    np.testing.assert_allclose(np.diff(links, axis=1, prepend=0.0), true, atol=np.radians(0.1))


def test_forces_at_rest_are_gravity_in_the_link(lab):
    lab.open()
    lab.order("hand bend=90 over=0.2 hold=2")
    frame = of(m.ImuFrame, lab.run(1.0))[-1]
    links = np.radians(90) / 5 * np.arange(1, 6)
    expected = -9.81 * np.stack([-np.sin(links), np.zeros(5), np.cos(links)], axis=1)
    np.testing.assert_allclose(frame.specific_forces, expected, atol=0.01)


def test_a_cable_pulls_the_arm_to_its_side(lab):
    lab.pulling()
    lab.run(1.0, pull=(20.0, 0.0))
    assert np.all(lab.bench.arm.angles > 0.05)
    frame = of(m.TensionFrame, lab.frames)[-1]
    assert frame.set_points == (20.0, 0.0)
    assert frame.measured == pytest.approx((20.0, 0.0), abs=0.3)


@pytest.mark.parametrize(
    ("end", "longest"),
    [("closed", 0.5), ("silent", 0.75), ("unplugged", 0.5), ("frozen", 0.75), ("deaf host", 1.0), ("lost", 0.75)],
)
def test_it_is_slack_in_time_however_the_host_goes(lab, end, longest):
    lab.pulling()
    begin = lab.now
    match end:
        case "closed":
            lab.shut()
        case "unplugged":
            lab.order("unplug for=5")
        case "frozen":
            lab.order("freeze for=5")
        case "lost":
            lab.order("lose for=5 way=down")
        case "deaf host":
            newest = lab.newest
            while lab.bench.controller.guard.set_points.any():
                lab.newest = newest  # it hears nothing new, and commands on
                lab.run(8 * STEP, pull=(20.0, 0.0))
                assert lab.now < begin + 5
    assert lab.now - begin + lab.seconds_to_slack() <= longest + 0.05
    assert lab.order("status")["largest_set_point"] <= 20.0


def test_without_hang_up_it_has_its_time_outs(tmp_path):
    lab = Lab(tmp_path, sees_hang_up=False)
    lab.pulling()
    lab.shut()
    lab.run(0.1)
    assert lab.bench.controller.guard.claimed
    assert lab.seconds_to_slack() <= 0.7
    lab.emulator.close()


@pytest.mark.parametrize("begin", ["unplug for=0.5", "reboot"])
def test_tension_is_zero_when_the_link_is_back_and_nobody_commands(lab, begin):
    lab.pulling()
    boots = {message.boot for message in of(m.Hello, lab.frames)}
    lab.order(begin)
    lab.run(0.6)
    if "unplug" in begin:
        lab.shut()
        lab.open()
    frames = lab.run(0.4, pull=(20.0, 0.0))
    assert not lab.bench.controller.guard.set_points.any()
    assert {ack.result for ack in of(m.Ack, frames)} == {m.Result.NOT_COMMANDER}
    hellos = of(m.Hello, lab.frames)
    assert len(hellos) == 2
    assert (hellos[-1].boot in boots) == ("unplug" in begin)


def test_an_unplugged_port_is_gone_with_its_link_and_comes_back(lab):
    lab.open()
    lab.run(0.1)
    lab.order("unplug for=0.5")
    lab.run(0.25)
    assert not lab.link.is_symlink()
    with pytest.raises(OSError):
        os.write(lab.port, b"x")
    lab.run(0.5)
    lab.shut()
    lab.open()
    assert len(of(m.ImuFrame, lab.run(1.0))) == 60


def test_frames_of_before_do_not_reach_the_next_host(lab):
    lab.open()
    for _ in range(100):
        lab.now += STEP
        lab.emulator.step(lab.now)  # the host does not read
    lab.shut()
    lab.run(0.5)
    lab.open()
    assert isinstance(lab.run(0.5)[0].message, m.Hello)


def test_a_host_that_does_not_read_costs_whole_frames_only(lab):
    lab.open()
    for _ in range(60 * 20):
        lab.now += 1 / 60
        lab.emulator.step(lab.now)
    lab.run(1.0)
    assert lab.emulator.port.dropped > 0
    assert lab.decoder.refused == 0
    assert lab.arrivals.lost == lab.emulator.port.dropped


def test_damaged_and_noisy_lines_cost_what_they_touch(lab):
    lab.open()
    lab.run(0.1)
    lab.order("damage share=0.2 for=3")
    lab.order("noise share=0.2 for=3")
    lab.run(3.1)
    good = lab.decoder.good
    assert lab.decoder.refused > 20
    assert lab.arrivals.lost > 20
    assert not lab.decoder.errors[Garbage.PAYLOAD]
    lab.run(1.0)
    assert lab.decoder.good - good >= 125


def test_repeated_and_late_frames_are_told_by_their_numbers(lab):
    lab.open()
    lab.run(0.1)
    lab.order("repeat share=0.5 for=1")
    lab.run(1.2)
    repeated = lab.arrivals.repeated
    lab.order("late share=0.3 by=0.1 for=1")
    lab.run(1.5)
    assert repeated == pytest.approx(65, abs=25)
    assert lab.arrivals.late > 20
    assert lab.arrivals.lost == 0


def test_sensors_drop_out_clip_and_run_low(lab):
    lab.open()
    lab.run(0.1)
    lab.order("drop sensor=3 for=0.5")
    lab.order("clip sensor=2 range=0 for=0.5")
    lab.order("battery sensor=5 percent=7")
    frames = lab.run(0.4)
    image = of(m.ImuFrame, frames)[-1]
    assert image.present.tolist() == [True, True, False, True, True]
    assert set(of(m.Fault, frames)) == {m.Fault(m.FaultCode.SENSOR_LOST, 3), m.Fault(m.FaultCode.BATTERY_LOW, 5)}
    status = of(m.Status, frames)[-1]
    assert status.faults == 1 << m.FaultCode.SENSOR_LOST | 1 << m.FaultCode.BATTERY_LOW
    assert status.batteries[4] == 7
    lab.order("hand bend=30 over=0.1 hold=0")
    assert of(m.ImuFrame, lab.run(0.05))[-1].clipped.tolist() == [False, True, False, False, False]
    assert of(m.ImuFrame, lab.run(0.5))[-1].present.all()


def test_the_clock_drifts_as_told_and_wraps(tmp_path):
    lab = Lab(tmp_path, clock_start=WRAP - 500_000)
    lab.open()
    lab.order("drift ppm=500")
    frames = [frame for frame in lab.run(2.0) if isinstance(frame.message, m.ImuFrame)]
    assert len(frames) in (120, 121)
    assert frames[0].time > frames[-1].time
    device = lab.order("status")["device_time"]
    assert device == pytest.approx(WRAP - 500_000 + 2_001_000, abs=3_000)
    lab.shut()
    lab.emulator.close()


def test_clear_ends_what_lasts_and_what_is_to_come(lab):
    lab.open()
    lab.order("lose for=100")
    lab.order("drop sensor=1 for=100")
    lab.order("freeze for=100")
    lab.order("at 1000 unplug")
    assert lab.run(0.2) == []
    assert lab.order("status")["waiting_orders"] == 1
    lab.order("clear")
    frames = lab.run(0.5)
    assert of(m.ImuFrame, frames)[-1].present.all()
    assert lab.order("status")["waiting_orders"] == 0
    assert not lab.bench.deaf


@pytest.mark.parametrize("text", ["drop sensor=6", "drop", "what"])
def test_orders_that_are_none_are_answered_by_what_is_wrong(lab, text):
    answer = lab.order(text)
    assert answer["ok"] is False
    assert "allowed" in answer["error"]


def test_a_script_s_orders_come_at_their_time(lab):
    lab.open()
    lab.order("at 0.5 drop sensor=1 for=0.2")
    images = of(m.ImuFrame, lab.run(1.0))
    gone = [k for k, image in enumerate(images) if not image.present[0]]
    assert gone[0] == pytest.approx(30, abs=1)
    assert len(gone) == pytest.approx(12, abs=1)


def test_a_slow_line_is_slow(tmp_path):
    lab = Lab(tmp_path, baud=115200.0)
    lab.open()
    lab.run(0.2)
    arrived = []
    for _ in range(480):
        before = len(lab.frames)
        lab.run(STEP)
        arrived += [
            lab.emulator.clock.at(lab.now) - frame.time
            for frame in lab.frames[before:]
            if isinstance(frame.message, m.ImuFrame)
        ]
    assert 7_100 <= np.median(arrived) <= 7_100 + 2 * STEP * 1e6
    lab.shut()
    lab.emulator.close()


def test_a_machine_that_sleeps_skips_time_and_says_so(lab):
    lab.open()
    lab.run(0.2)
    lab.now += 30.0
    lab.run(1.0)
    assert lab.emulator.skipped == pytest.approx(30.0, abs=1.0)
    assert len(of(m.ImuFrame, lab.run(1.0))) == 60


def test_the_truth_is_complete(lab):
    lab.run(1.01)
    lab.emulator.close()
    with lab.truth.open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 60
    assert list(rows[0])[:2] == ["device_time_us", "monotonic_s"]
    assert len(rows[0]) == 2 + 10 + 4 + 2
