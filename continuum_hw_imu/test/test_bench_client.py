"""The client beside the controller itself: greeting, claims, set points and their answers, a spoilt line."""

import pytest
from looped_bench import HELLO, LoopedBench

from continuum_hw_imu.protocol.messages import GuardState, Hello, Result

SOON = 0.2


@pytest.fixture
def bench():
    return LoopedBench()


def test_it_knows_who_is_there_and_forgets_it_with_the_line(bench):
    assert bench.client.hello == HELLO
    first = bench.client.conversations
    bench.client._begin()
    assert bench.client.hello is None
    assert not bench.client.commands
    bench.connect()
    assert bench.client.hello == HELLO
    assert bench.client.conversations == first + 2


def test_each_conversation_commands_by_a_word_of_its_own(bench):
    """What is still under way from the one before commands nothing."""
    words = []
    for _ in range(3):
        bench.client._begin()
        bench.connect()
        words.append(bench.client._token)
    assert len(set(words)) == 3


def test_it_asks_who_is_there_until_it_is_reported(bench):
    bench.client._begin()
    bench.link.deaf = True
    assert not bench.client.wait_for(lambda: bench.client.hello is not None, 0.0)
    bench.link.deaf = False
    bench.client.ask_who(1e9)
    assert bench.client.hello == HELLO


def test_it_commands_what_it_claimed(bench):
    client = bench.client
    assert client.claim(SOON) is Result.DONE
    assert client.commands
    client.set_tension([5.0, 1.0], None)
    bench.pass_time(0.1)
    assert bench.set_points == [5.0, 1.0]
    assert client.release(SOON) is Result.DONE
    assert not client.commands
    bench.pass_time(1.0)
    assert bench.set_points == [0.0, 0.0]
    assert client.results.unanswered == 0


def test_it_learns_that_it_no_longer_commands(bench):
    bench.client.claim(SOON)
    bench.pass_time(1.0)  # without a heartbeat
    assert not bench.client.commands


def test_no_answer_is_none(bench):
    bench.link.deaf = True
    assert bench.client.claim(SOON) is None
    assert bench.client.results.unanswered >= 1


def test_old_commands_are_reported_as_old(bench):
    bench.client.claim(SOON)
    bench.pass_time(0.2)
    bench.client.beat()
    bench.client.set_tension([5.0, 0.0], bench.now - 0.1)
    assert bench.client.results.counts[Result.STALE] == 0
    bench.client.set_tension([5.0, 0.0], bench.now - 1.0)
    assert bench.client.results.counts[Result.STALE] == 1


def test_repeated_and_overtaken_frames_are_counted_and_not_handed_on(bench):
    status = bench.controller.status()
    before = len(bench.received)
    first, second = bench.frame(status), bench.frame(status)
    bench.deliver(second + first + second)
    assert len(bench.received) == before + 1
    assert (bench.client.arrivals.late, bench.client.arrivals.repeated) == (1, 1)


def test_what_was_overtaken_says_nothing_of_now(bench):
    """A status from before the stop that comes after the stop's own."""
    before = bench.frame(bench.controller.status())
    bench.client.stop()
    bench.deliver(before)
    assert bench.client.conversation.status.state is GuardState.STOPPED


def test_damage_costs_the_frames_that_it_touches(bench):
    status = bench.controller.status()
    hurt = bytearray(bench.frame(status))
    hurt[5] ^= 0x10
    before = len(bench.received)
    bench.deliver(bytes(hurt) + bench.frame(status))
    assert len(bench.received) == before + 1
    assert bench.client.decoder.refused == 1
    assert bench.client.arrivals.lost == 1


def test_a_device_that_begins_again_is_another_conversation(bench):
    bench.client.claim(SOON)
    number = bench.client.conversations
    bench.say(
        Hello(8, *(getattr(HELLO, name) for name in ("firmware", "sample_rate", "sensors", "n_cables", "limits")))
    )
    assert bench.client.conversations == number + 1
    assert not bench.client.commands
    assert bench.client.hello.boot == 8
    assert bench.received[-1].conversation == number + 1


def test_a_port_that_is_not_read_excuses_a_silence_for_as_long_as_a_bench_pulls_on(bench):
    bench.link.emptied = last = bench.now
    bench.say(bench.controller.status())
    assert bench.client.silent_for(last + 1.9) == 0.0
    assert bench.client.silent_for(last + 2.1) == pytest.approx(2.1)
    bench.link.emptied = last + 1.0
    assert bench.client.silent_for(last + 1.9) == pytest.approx(1.0)


def test_times_of_the_device_become_the_hosts(bench):
    for _ in range(10):
        bench.now += 0.1
        bench.say(bench.controller.status())
    assert bench.received[-1].time == pytest.approx(bench.now, abs=1e-6)
    assert bench.received[-1].device_time == bench.device_time


def test_an_answer_that_takes_longer_than_the_next_question_counts(bench):
    kept = []

    def answer_the_first(data: bytes) -> None:
        kept.append(data)
        if len(kept) == 3:
            LoopedBench.hear(bench, kept[0])

    bench.hear = answer_the_first
    assert bench.client.claim(1.0) is Result.DONE
    assert len(kept) == 3
