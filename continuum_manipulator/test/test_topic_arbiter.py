"""Who speaks on a topic where the page's user may speak."""

from continuum_manipulator.topic_arbiter import PATIENCE, TopicArbiter

FRAME = 0.04


def frames(arbiter: TopicArbiter, start: float, count: int) -> list[bool]:
    return [arbiter.may_speak(start + i * FRAME) for i in range(count)]


def test_an_unused_topic_is_spoken_on_from_the_second_asking() -> None:
    assert frames(TopicArbiter(), 0.0, 4) == [False, True, True, True]


def test_another_s_word_is_kept_for_a_while_and_one_s_own_is_not() -> None:
    arbiter = TopicArbiter()
    frames(arbiter, 1.0 - 2 * FRAME, 2)
    arbiter.said(7)
    arbiter.received(7, 1.0)
    assert arbiter.may_speak(1.0)
    arbiter.received(8, 1.0)
    assert not any(frames(arbiter, 1.0 + FRAME, 10))
    assert frames(arbiter, 1.0 + PATIENCE + FRAME, 2) == [False, True]


def test_a_process_that_stood_still_hears_what_waits_before_it_speaks() -> None:
    """Whether another had the topic before, or began meanwhile."""
    for before in (False, True):
        arbiter = TopicArbiter()
        frames(arbiter, 0.0, 3)
        if before:
            arbiter.received(1, 0.2)
            assert not arbiter.may_speak(0.2 + FRAME)
        after = 0.2 + 10 * PATIENCE
        assert not arbiter.may_speak(after)
        arbiter.received(2, after)
        assert not arbiter.may_speak(after + FRAME)


def test_a_topic_is_another_s_only_once_another_was_received() -> None:
    arbiter = TopicArbiter()
    assert not arbiter.may_speak(0.0)
    assert not arbiter.is_taken(0.0)
    arbiter.received(1, 1.0)
    assert arbiter.is_taken(1.0 + FRAME)
    assert not arbiter.is_taken(1.0 + PATIENCE + FRAME)
