"""The host's end of the protocol: the latest messages of the bench, requests and their answers, the two clocks.

The link's thread calls :meth:`BenchClient._take`, which reads frames and passes each on; the commanding thread calls
everything else. Requests are answered within milliseconds, so that thread may wait for an answer.
"""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Callable, Sequence

from continuum_hw_imu.bench_fit import LONGEST_PATIENCE
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
"""Time after which an unanswered request is sent again [s]."""

BEGAN_AGAIN = 2_000_000
"""A frame older than the newest by more than this [us] is not late: the device's clock restarted."""

_REMEMBERED = 256
"""Number of past requests whose time of sending is remembered."""

HELLO_AGAIN = 0.2
"""Time after which a device that has not identified itself is asked again [s]."""


class BenchClient:
    """Client of a bench controller; it maintains the link from :meth:`start` to :meth:`close`.

    Args:
        port, baud_rate: name and speed of the serial port.
        received: function that the link's thread calls with every new message, but not with repeated frames or frames
            that arrive after later ones.
        rng: generator of tokens; random by default.
        now: `time.monotonic`, except in tests [s].

    Attributes:
        link: the port.
        decoder: decoder of frames, which counts invalid ones.
        arrivals: counts of lost, late and repeated frames.
        clock: map from the device's clock to `time.monotonic`.
        results: results of requests.
        conversation: conversation with the connected device.
        conversations: number of conversations.
        commands: whether the device has accepted this host as its commander.
    """

    def __init__(
        self,
        port: str,
        baud_rate: int,
        received: Callable[[Received], None],
        rng: random.Random | None = None,
        now: Callable[[], float] = time.monotonic,
    ) -> None:
        self.link = SerialLink(port, baud_rate, self._take, self._begin)
        self._hand_on = received
        self._rng = rng or random.SystemRandom()
        self._now = now
        self._news = threading.Condition()
        self._answers: dict[int, Result | None] = {}  # to the transmissions of the pending request, by number
        self._writer = FrameWriter()
        self._sent = [(-1, 0.0)] * _REMEMBERED  # sequence number and time of the latest requests
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
        """Open the port as soon as it exists."""
        self.link.start()

    def close(self) -> None:
        """Close the port; a second call does nothing."""
        self.link.close()

    @property
    def hello(self) -> Hello | None:
        """Identification of the device, None before it arrives."""
        return self.conversation.hello

    def silent_for(self, now: float) -> float:
        """Return the time since the last valid frame [s]; infinite before the first on this link.

        Time in which this process did not get round to reading the port is no silence of the bench, unless it is so
        long that any bench has let the cables go.
        """
        last = self.conversation.last
        return now - last if now - last > LONGEST_PATIENCE else max(0.0, min(now, self.link.emptied) - last)

    def wait_for(self, condition: Callable[[], bool], timeout: float) -> bool:
        """Wait until a condition on the received data holds; return whether it did within ``timeout`` [s]."""
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
        """Ask an unknown device for its identification; call this often."""
        if self.hello is None and self.link.is_open and now - self._asked_hello >= HELLO_AGAIN:
            self._asked_hello = now
            self._send(HelloRequest())

    def claim(self, timeout: float) -> Result | None:
        """Become the commander, waiting up to ``timeout`` [s] for slack cables; return None without an answer."""
        result = self._ask(Claim(self._token), timeout, until=lambda result: result is not Result.NOT_SLACK)
        self.commands = result is Result.DONE
        return result

    def release(self, timeout: float) -> Result | None:
        """Give back the claim."""
        self.commands = False
        return self._ask(Release(self._token), timeout)

    def let_go(self, timeout: float) -> Result | None:
        """Make the cables slack at once; later set points pull again."""
        return self._ask(LetGo(self._token), timeout)

    def reset_stop(self, timeout: float) -> Result | None:
        """End a stop, as the commander."""
        return self._ask(ResetStop(self._token, self.conversation.newest % WRAP_TIME), timeout)

    def stop(self) -> None:
        """Request slack cables at once; repeat this until the status confirms it."""
        self._say(Stop())

    def beat(self) -> None:
        """Send a heartbeat of the commander."""
        self._send(Heartbeat(self._token))

    def set_tension(self, tensions: Sequence[float], decided: float | None) -> None:
        """Send set points (n_cables,) [N].

        Args:
            tensions: finite, none negative.
            decided: time of the decision by `time.monotonic` [s]; None for the present.
        """
        with self._news:
            as_of = self.conversation.newest
            if decided is not None and self.clock.known:
                as_of = min(as_of, self.clock.device_time(decided))
        self._say(SetTension(self._token, as_of % WRAP_TIME, tuple(tensions)))

    def _ask(
        self, request: Message, timeout: float, until: Callable[[Result], bool] = lambda _result: True
    ) -> Result | None:
        """Send a request repeatedly until an answer satisfies ``until``; return the last answer."""
        deadline = time.monotonic() + timeout
        result: Result | None = None
        with self._news:
            self._answers.clear()
            while (left := deadline - time.monotonic()) > 0:
                self._answers[self._writer.sequence] = None
                self._say(request)
                if not self._news.wait_for(self._answered, min(left, AGAIN)):
                    continue  # an answer to an earlier transmission may still arrive
                result = next(answer for answer in self._answers.values() if answer is not None)
                if until(result):
                    break
                self._answers.clear()
                self._news.wait(min(max(0.0, deadline - time.monotonic()), AGAIN / 2))
        return result

    def _answered(self) -> bool:
        return any(answer is not None for answer in self._answers.values())

    def _say(self, request: Message) -> None:
        """Send a request that expects an answer."""
        self.results.asked += 1
        self._send(request)

    def _send(self, message: Message) -> None:
        sequence, now = self._writer.sequence, self._now()
        self._sent[sequence % _REMEMBERED] = (sequence, now)
        self.link.send(self._writer.write(message, int(now * MICROSECONDS)))

    def _begin(self) -> None:
        """Start after the port was opened."""
        with self._news:
            self.decoder.forget()
            self._asked_hello = -HELLO_AGAIN
            self._forget()
            self._news.notify_all()

    def _forget(self) -> None:
        """Start a new conversation, with another device or with the same one after its restart."""
        self.arrivals.forget()
        self._device_time.forget()
        self.clock.forget()
        self.conversation = Conversation()
        self.conversations += 1
        self.commands = False
        self._token = self._rng.randrange(1, 1 << 32)

    def _take(self, data: bytes, now: float) -> None:
        """Process received bytes."""
        for frame in self.decoder.feed(data):
            received = self._note(frame, now)
            if received is not None:
                self._hand_on(received)

    def _note(self, frame: Frame, now: float) -> Received | None:
        """Store the content of a frame; return None if it must not be passed on."""
        with self._news:
            if isinstance(frame.message, Hello) and self.hello is not None and frame.message != self.hello:
                self._forget()  # a restart, or changed sensors, places or limits
            arrival = self.arrivals.take(frame.sequence)
            if arrival is Arrival.REPEATED:
                return None
            device_time = self._device_time.unwrapped(frame.time)
            if self._goes_back(frame.message, arrival, device_time):  # it restarted, and its Hello was lost
                self._forget()
                self._news.notify_all()
                return None
            self.clock.received(device_time, now, self._asked_at(frame.message))
            talk = self.conversation
            talk.last, talk.newest = now, max(talk.newest, device_time)
            overtaken = arrival is Arrival.LATE
            if isinstance(frame.message, ImuFrame) and not overtaken:
                talk.measured = device_time
            if not overtaken or isinstance(frame.message, Ack):  # a late answer is still valid
                self._keep(frame.message)
            self._news.notify_all()
            if overtaken:
                return None
            clock = self.clock
            times = clock.host_time(device_time), clock.error(device_time), now
            return Received(frame.message, *times, device_time, self.conversations)

    def _asked_at(self, message: Message) -> float | None:
        """Return when the request was sent that a message answers; None if it answers none."""
        if not isinstance(message, Ack):
            return None
        sequence, sent = self._sent[message.sequence % _REMEMBERED]
        return sent if sequence == message.sequence else None

    def _goes_back(self, message: Message, arrival: Arrival, device_time: int) -> bool:
        """Return whether the device's clock went back; times of sensor frames increase with their numbers."""
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
