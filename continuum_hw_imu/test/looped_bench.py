"""A bench client whose port leads straight to a bench controller: no port, no thread, no time but the test's."""

import math

from continuum_hw_imu.link.bench_client import BenchClient
from continuum_hw_imu.protocol.frame import FrameWriter
from continuum_hw_imu.protocol.messages import Hello, Message, ReceiverLimits, SensorPlace
from continuum_hw_imu.receiver.bench_controller import BenchController

HELLO = Hello(7, "looped", 60.0, tuple(SensorPlace(k, f"S{k}") for k in (3, 1, 5, 2, 4)), 2, ReceiverLimits())


class LoopedLink:
    """In the place of `SerialLink`; lets nothing through while it is cut."""

    def __init__(self) -> None:
        self.is_open, self.problem, self.refused, self.openings, self.reopened = True, "", 0, 1, 0
        self.emptied = math.inf  # it is read at any time
        self.client: BenchClient | None = None
        self.bench: LoopedBench | None = None
        self.deaf = False

    def start(self) -> None: ...

    def close(self) -> None:
        self.is_open, self.problem = False, "closed"

    def reopen(self) -> None:
        self.reopened += 1

    def send(self, data: bytes) -> bool:
        if not self.is_open or self.deaf:
            return False
        self.bench.hear(data)
        return True


class LoopedBench:
    """A controller and the client at it; both ends' clocks show ``now`` [s]."""

    def __init__(self, hello: Hello = HELLO) -> None:
        self.received, self.now = [], 10.0
        self.controller = BenchController(hello)
        self.client = BenchClient("nowhere", 921_600, self.received.append, now=lambda: self.now)
        self.link = LoopedLink()
        self.link.client, self.link.bench = self.client, self
        self.client.link = self.link
        self._writer = FrameWriter()
        self.connect()

    def connect(self) -> None:
        """The port is opened."""
        self.client._begin()
        for message in self.controller.connect():
            self.say(message)

    def hear(self, data: bytes) -> None:
        for answer in self.controller.hear(data, self.device_time):
            self.say(answer)
        self.report_news()

    @property
    def device_time(self) -> int:
        return round(self.now * 1e6)

    def frame(self, message: Message) -> bytes:
        """The bytes of the bench's next frame."""
        return self._writer.write(message, self.device_time)

    def say(self, message: Message) -> None:
        self.deliver(self.frame(message))

    def deliver(self, data: bytes) -> None:
        self.client._take(data, self.now)

    def report_news(self) -> None:
        for message in self.controller.news(self.device_time):
            self.say(message)

    def pass_time(self, duration: float, steps: int = 10) -> None:
        """Let the controller run on, by which its clock and the host's go on."""
        for _ in range(steps):
            self.now += duration / steps
            self.controller.move_on(self.device_time, duration / steps)
        self.report_news()

    @property
    def set_points(self) -> list[float]:
        return self.controller.guard.set_points.tolist()
