"""The controller's side of the talk: what it answers to which bytes, and what it says of itself."""

from itertools import pairwise

import pytest

from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.frame import Frame, FrameWriter
from continuum_hw_imu.receiver.bench_controller import STATUS_PERIOD, BenchController

HELLO = m.Hello(5, "test", 60.0, (m.SensorPlace(1, "a"), m.SensorPlace(2, "b")), 2, m.ReceiverLimits())
TOKEN = 77
TICK = 10_000


class Talk:
    """A controller, and a host that writes frames by hand."""

    def __init__(self) -> None:
        self.device = BenchController(HELLO)
        self.host = FrameWriter()
        self.now = 1_000_000

    def say(self, *requests: m.Message) -> list[m.Message]:
        return self.device.hear(b"".join(self.host.write(request, 0) for request in requests), self.now)

    def results(self, *requests: m.Message) -> list[m.Result]:
        return [answer.result for answer in self.say(*requests) if isinstance(answer, m.Ack)]

    def tick(self) -> list[m.Message]:
        self.device.move_on(self.now, TICK * 1e-6)
        self.now += TICK
        return self.device.news(self.now)

    def pull(self, tension: float = 5.0) -> m.SetTension:
        return m.SetTension(TOKEN, self.now, (tension, 0.0))


@pytest.fixture
def talk() -> Talk:
    talk = Talk()
    assert talk.device.connect() == [HELLO]
    assert talk.say(m.HelloRequest()) == [HELLO]
    return talk


def test_requests_are_answered_by_their_number_and_type(talk):
    number = talk.host.sequence
    (claim, pull) = talk.say(m.Claim(TOKEN), talk.pull())
    assert claim == m.Ack(number, m.Claim.TYPE, m.Result.DONE)
    assert pull == m.Ack(number + 1, m.SetTension.TYPE, m.Result.DONE)


def test_every_request_is_carried_out(talk):
    done, stopped = m.Result.DONE, m.Result.STOPPED
    requests = [
        m.Claim(TOKEN),
        talk.pull(),
        m.LetGo(TOKEN),
        m.Stop(),
        talk.pull(),
        m.ResetStop(TOKEN, talk.now),
        m.Release(TOKEN),
    ]
    assert talk.results(*requests) == [done, done, done, done, stopped, done, done]
    assert not talk.device.guard.claimed


def test_a_heartbeat_is_answered_only_where_it_is_refused(talk):
    assert talk.say(m.Claim(TOKEN), m.Heartbeat(TOKEN))[1:] == []
    assert talk.results(m.Heartbeat(TOKEN + 1)) == [m.Result.NOT_COMMANDER]


def test_a_frame_that_comes_twice_counts_once(talk):
    talk.say(m.Claim(TOKEN))
    twice = Frame(talk.host.sequence, 0, talk.pull()).encode() * 2
    assert len(talk.device.hear(twice, talk.now)) == 1


def test_a_claim_that_comes_again_late_lets_nothing_go(talk):
    late = Frame(talk.host.sequence, 0, m.Claim(TOKEN)).encode()
    talk.device.hear(late, talk.now)
    talk.host.sequence += 1
    talk.say(talk.pull())
    talk.tick()
    assert talk.device.hear(late, talk.now) == []
    assert talk.device.guard.state is m.GuardState.FOLLOWING


def test_what_was_overtaken_is_refused_but_a_stop_is_obeyed(talk):
    talk.say(m.Claim(TOKEN))
    number = talk.host.sequence
    talk.host.sequence += 2
    talk.say(m.Heartbeat(TOKEN))
    (answer,) = talk.device.hear(Frame(number, 0, talk.pull()).encode(), talk.now)
    assert answer.result is m.Result.OUT_OF_ORDER
    (answer,) = talk.device.hear(Frame(number + 1, 0, m.Stop()).encode(), talk.now)
    assert answer.result is m.Result.DONE
    assert talk.device.guard.state is m.GuardState.STOPPED


def test_a_stop_is_obeyed_that_a_greeting_has_overtaken(talk):
    """The greeting begins the count anew; the stop, sent before it, has a number that seems to have come."""
    number = talk.host.sequence
    talk.host.sequence += 1
    talk.say(m.HelloRequest())
    (answer,) = talk.device.hear(Frame(number, 0, m.Stop()).encode(), talk.now)
    assert answer.result is m.Result.DONE
    assert talk.device.guard.state is m.GuardState.STOPPED


@pytest.mark.parametrize("again", [0, 3, 40_000])
def test_a_host_that_begins_again_may_count_again(talk, again):
    talk.say(m.Claim(TOKEN), m.Release(TOKEN))
    talk.host = FrameWriter()
    talk.host.sequence = again
    assert talk.results(m.HelloRequest(), m.Claim(TOKEN + 1)) == [m.Result.DONE]


def test_half_a_frame_of_an_earlier_host_harms_no_later_one(talk):
    talk.device.hear(Frame(0, 0, m.Stop()).encode()[:-3], talk.now)
    talk.device.disconnect()
    talk.device.connect()
    assert talk.device.hear(Frame(0, 0, m.HelloRequest()).encode()[1:], talk.now) == [HELLO]


def test_status_comes_ten_times_a_second_and_when_something_changes(talk):
    times = []
    for k in range(100):
        if k == 55:
            talk.say(m.Claim(TOKEN))
        if k >= 55:
            talk.say(m.Heartbeat(TOKEN))
        times += [talk.now for message in talk.tick() if isinstance(message, m.Status)]
    gaps = [later - earlier for earlier, later in pairwise(times)]
    assert len(times) == 11
    assert max(gaps) == STATUS_PERIOD
    assert min(gaps) < STATUS_PERIOD


def test_status_reports_what_was_received(talk):
    talk.say(m.Claim(TOKEN))
    talk.device.hear(b"\0rubbish\0", talk.now)
    talk.device.batteries = [50, None]
    status = talk.device.status()
    assert (status.received, status.refused, status.claimed, status.batteries) == (2, 1, True, (50, None))


@pytest.mark.parametrize(
    ("keep", "code"), [(m.Heartbeat(TOKEN), m.FaultCode.COMMANDS_STOPPED), (None, m.FaultCode.HEARTBEATS_STOPPED)]
)
def test_silence_is_reported_once_and_stands_until_it_ends(talk, keep, code):
    talk.say(m.Claim(TOKEN), talk.pull())
    received = []
    for _ in range(150):
        if keep:
            talk.say(keep)
        received += talk.tick()
    assert [message for message in received if isinstance(message, m.Fault)] == [m.Fault(code)]
    assert talk.device.status().faults == 1 << code
    talk.say(m.Claim(TOKEN), talk.pull())
    talk.tick()
    assert talk.device.status().faults == 0


def test_a_line_that_is_cut_ends_the_claim(talk):
    talk.say(m.Claim(TOKEN), talk.pull())
    talk.tick()
    talk.device.disconnect()
    assert talk.device.status().state is m.GuardState.LETTING_GO
    assert not talk.device.status().claimed


def test_tension_frames_have_what_is_in_force(talk):
    talk.say(m.Claim(TOKEN), talk.pull(40.0))
    talk.tick()
    assert talk.device.tension_frame([1.5, None]) == m.TensionFrame((2.0, 0.0), (1.5, None))
