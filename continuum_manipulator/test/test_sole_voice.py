"""Who speaks on a topic where the page's user may speak."""

from continuum_manipulator.sole_voice import PATIENCE, SoleVoice

FRAME = 0.04


def frames(voice: SoleVoice, start: float, count: int) -> list[bool]:
    return [voice.may_speak(start + i * FRAME) for i in range(count)]


def test_an_unused_topic_is_spoken_on_from_the_second_asking() -> None:
    assert frames(SoleVoice(), 0.0, 4) == [False, True, True, True]


def test_another_s_word_is_kept_for_a_while_and_one_s_own_is_not() -> None:
    voice = SoleVoice()
    frames(voice, 1.0 - 2 * FRAME, 2)
    voice.said(7)
    voice.heard(7, 1.0)
    assert voice.may_speak(1.0)
    voice.heard(8, 1.0)
    assert not any(frames(voice, 1.0 + FRAME, 10))
    assert frames(voice, 1.0 + PATIENCE + FRAME, 2) == [False, True]


def test_a_process_that_stood_still_hears_what_waits_before_it_speaks() -> None:
    """Whether another had the topic before, or began meanwhile."""
    for before in (False, True):
        voice = SoleVoice()
        frames(voice, 0.0, 3)
        if before:
            voice.heard(1, 0.2)
            assert not voice.may_speak(0.2 + FRAME)
        after = 0.2 + 10 * PATIENCE
        assert not voice.may_speak(after)
        voice.heard(2, after)
        assert not voice.may_speak(after + FRAME)


def test_a_topic_is_another_s_only_once_another_was_heard() -> None:
    voice = SoleVoice()
    assert not voice.may_speak(0.0)
    assert not voice.is_taken(0.0)
    voice.heard(1, 1.0)
    assert voice.is_taken(1.0 + FRAME)
    assert not voice.is_taken(1.0 + PATIENCE + FRAME)
