"""The host's end of the protocol: what the bench said last, requests and their answers, the two clocks.

The link's thread calls :meth:`BenchClient._take`, which reads frames and hands each on; everything else is called by
the thread that commands. Requests are answered within milliseconds, so that thread may wait for an answer.
"""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Callable, Sequence

from continuum_hw_imu.link.received import Conversation, Received, Results
from continuum_hw_imu.link.serial_link import SerialLink
from continuum_hw_imu.protocol.clock_map import ClockMap
from continuum_hw_imu.protocol.decoder import Decoder
from continuum_hw_imu.protocol.device_time import MICROSECONDS, DeviceTime
from continuum_hw_imu.protocol.frame import WRAP_TIME, Frame, FrameWriter
from continuum_hw_imu.protocol.messages import (
    Ack,
    Claim,
    Heartbeat,
    Hello,
    HelloRequest,
    ImuFrame,
    LetGo,
    Message,
    Release,
    ResetStop,
    Result,
    SetTension,
    Status,
    Stop,
)
from continuum_hw_imu.protocol.sequence import Arrival, SequenceTracker

AGAIN = 0.1
"""An unanswered request is sent again after this time [s]."""

BEGAN_AGAIN = 2_000_000
"""A frame this much [us] before the newest is not late: the device's clock began anew."""

HELLO_AGAIN = 0.2
"""A device that did not say who it is is asked again after this time [s]."""


class BenchClient:
    """Keeps the line from :meth:`start` to :meth:`close`.

    Args:
        port, baud_rate: of the serial port.
        heard: is given every new message, by the link's thread; repeated frames and those that a later one has
            overtaken are not given on.
        rng: draws tokens; by default at random.

    Attributes:
        link: the port.
        decoder: counts what was no good frame.
        arrivals: counts frames that were lost, late or repeated.
        clock: from the device's clock to `time.monotonic`.
        results: what became of requests.
        conversation: with the device at the other end.
        conversations: how many there were.
        commands: whether the device was told that this host commands, and said yes.
    """

    def __init__(
        self, port: str, baud_rate: int, received: Callable[[Received], None], rng: random.Random | None = None
    ) -> None:
        self.link = SerialLink(port, baud_rate, self._take, self._begin)
        self._hand_on = received
        self._rng = rng or random.SystemRandom()
        self._news = threading.Condition()
        self._answers: dict[int, Result | None] = {}  # to the sendings of the request under way, by number
        self._writer = FrameWriter()
        self._device_time = DeviceTime()
        self._asked_hello = -HELLO_AGAIN
        self._token = 0
        self.decoder = Decoder.of_host()
        self.arrivals = SequenceTracker()
        self.clock = ClockMap()
        self.results = Results()
        self.conversation = Conversation()
        self.conversations = 0
        self.commands = False

    def start(self) -> None:
        """Open the port as soon as it is there."""
        self.link.start()

    def close(self) -> None:
        """Close the port; a second call does nothing."""
        self.link.close()

    @property
    def hello(self) -> Hello | None:
        """Who the device is, once it said so."""
        return self.conversation.hello

    def silent_for(self, now: float) -> float:
        """Time since the last good frame [s]; infinite where none came on this line."""
        return now - self.conversation.last

    def wait_for(self, condition: Callable[[], bool], timeout: float) -> bool:
        """Wait until what was heard fulfils a condition; whether it did within ``timeout`` [s]."""
        deadline = time.monotonic() + timeout
        with self._news:
            while not condition():
                self.ask_who(time.monotonic())
                left = deadline - time.monotonic()
                if left <= 0:
                    return False
                self._news.wait(min(left, HELLO_AGAIN))
        return True

    def ask_who(self, now: float) -> None:
        """Ask a device that did not say who it is; to be called often."""
        if self.hello is None and self.link.is_open and now - self._asked_hello >= HELLO_AGAIN:
            self._asked_hello = now
            self._send(HelloRequest())

    def claim(self, timeout: float) -> Result | None:
        """Become the commander, waiting for slack cables as long as ``timeout`` [s] allows; None without an answer."""
        result = self._ask(Claim(self._token), timeout, until=lambda result: result is not Result.NOT_SLACK)
        self.commands = result is Result.DONE
        return result

    def release(self, timeout: float) -> Result | None:
        """Command no more."""
        self.commands = False
        return self._ask(Release(self._token), timeout)

    def let_go(self, timeout: float) -> Result | None:
        """Slack cables at once; later set points pull again."""
        return self._ask(LetGo(self._token), timeout)

    def reset_stop(self, timeout: float) -> Result | None:
        """End a stop, as the commander."""
        return self._ask(ResetStop(self._token, self.conversation.newest % WRAP_TIME), timeout)

    def stop(self) -> None:
        """Ask for slack cables at once; to be repeated until the status tells it."""
        self._say(Stop())

    def beat(self) -> None:
        """Say that the commander lives."""
        self._send(Heartbeat(self._token))

    def set_tension(self, tensions: Sequence[float], decided: float | None) -> None:
        """Send set points (n_cables,) [N].

        Args:
            tensions: finite, none negative.
            decided: when, by `time.monotonic` [s]; None for just now.
        """
        with self._news:
            as_of = self.conversation.newest
            if decided is not None and self.clock.known:
                as_of = min(as_of, self.clock.device_time(decided))
        self._say(SetTension(self._token, as_of % WRAP_TIME, tuple(tensions)))

    def _ask(
        self, request: Message, timeout: float, until: Callable[[Result], bool] = lambda _result: True
    ) -> Result | None:
        """Send a request, again and again, until it is answered to satisfaction; the last answer."""
        deadline = time.monotonic() + timeout
        result: Result | None = None
        with self._news:
            self._answers.clear()
            while (left := deadline - time.monotonic()) > 0:
                self._answers[self._writer.sequence] = None
                self._say(request)
                if not self._news.wait_for(self._answered, min(left, AGAIN)):
                    continue  # an answer to any of the sendings may still come
                result = next(answer for answer in self._answers.values() if answer is not None)
                if until(result):
                    break
                self._answers.clear()
                self._news.wait(min(max(0.0, deadline - time.monotonic()), AGAIN / 2))
        return result

    def _answered(self) -> bool:
        return any(answer is not None for answer in self._answers.values())

    def _say(self, request: Message) -> None:
        """Send a request that is answered."""
        self.results.asked += 1
        self._send(request)

    def _send(self, message: Message) -> None:
        self.link.send(self._writer.write(message, int(time.monotonic() * MICROSECONDS)))

    def _begin(self) -> None:
        """The port was opened."""
        with self._news:
            self.decoder.forget()
            self._asked_hello = -HELLO_AGAIN
            self._forget()
            self._news.notify_all()

    def _forget(self) -> None:
        """Another device is at the other end, or the same one begins anew."""
        self.arrivals.forget()
        self._device_time.forget()
        self.clock.forget()
        self.conversation = Conversation()
        self.conversations += 1
        self.commands = False
        self._token = self._rng.randrange(1, 1 << 32)

    def _take(self, data: bytes, now: float) -> None:
        """Bytes came."""
        for frame in self.decoder.feed(data):
            received = self._note(frame, now)
            if received is not None:
                self._hand_on(received)

    def _note(self, frame: Frame, now: float) -> Received | None:
        """Keep what a frame says; None where it is not to be handed on."""
        with self._news:
            if isinstance(frame.message, Hello) and self.hello is not None and frame.message != self.hello:
                self._forget()  # another start, or other sensors, places or limits than it had told
            arrival = self.arrivals.take(frame.sequence)
            if arrival is Arrival.REPEATED:
                return None
            device_time = self._device_time.unwrapped(frame.time)
            if self._goes_back(frame.message, arrival, device_time):  # it began anew, and its greeting was lost
                self._forget()
                self._news.notify_all()
                return None
            self.clock.received(device_time, now)
            talk = self.conversation
            talk.last, talk.newest = now, max(talk.newest, device_time)
            overtaken = arrival is Arrival.LATE
            if isinstance(frame.message, ImuFrame) and not overtaken:
                talk.measured = device_time
            if not overtaken or isinstance(frame.message, Ack):  # an answer is one whenever it comes
                self._keep(frame.message)
            self._news.notify_all()
            if overtaken:
                return None
            host_time = self.clock.host_time(device_time)
            return Received(frame.message, host_time, now, device_time, self.conversations)

    def _goes_back(self, message: Message, arrival: Arrival, device_time: int) -> bool:
        """Whether the device's clock does. Instants of sensors' frames never go back where their numbers go on."""
        talk = self.conversation
        is_next_sample = isinstance(message, ImuFrame) and arrival is Arrival.NEW
        return device_time < talk.newest - BEGAN_AGAIN or (is_next_sample and device_time < talk.measured)

    def _keep(self, message: Message) -> None:
        talk = self.conversation
        match message:
            case Hello():
                talk.hello = message
            case Status():
                talk.status = message
                self.commands = self.commands and message.claimed
            case Ack(sequence, _, result):
                self.results.counts[result] += 1
                if sequence in self._answers:
                    self._answers[sequence] = result
                if result is Result.NOT_COMMANDER:
                    self.commands = False
