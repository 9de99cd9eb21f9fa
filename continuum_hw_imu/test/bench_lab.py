"""An emulated bench on a real pseudo-terminal, with a host by hand, in a time of its own; for tests."""

import json
import os
import termios
import tty
from pathlib import Path

from continuum.dynamics.model_file import load_model
from continuum_hw_imu.emulator.bench import Bench, BenchSettings
from continuum_hw_imu.emulator.emulator import Emulator, EmulatorSettings
from continuum_hw_imu.emulator.order_book import OrderBook
from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.decoder import Decoder
from continuum_hw_imu.protocol.frame import Frame, FrameWriter
from continuum_hw_imu.protocol.sequence import SequenceTracker
from continuum_hw_imu.sensor_quality import SensorQuality

TOKEN = 99
STEP = 1 / 480


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
        tty.setraw(self.port, termios.TCSANOW)  # without dropping what waits
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
            self.emulator.hear()
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

    def close(self) -> None:
        self.shut()
        self.emulator.close()


def of(kind: type[m.Message], frames: list[Frame]) -> list[m.Message]:
    return [frame.message for frame in frames if isinstance(frame.message, kind)]
