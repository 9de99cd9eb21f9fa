"""Joining by stamp: never two instants in one set, in order, nothing lost that could be joined, bounded."""

from types import SimpleNamespace

from hypothesis import given
from hypothesis import strategies as st

from continuum_manipulator.nodekit.stamps import Loss, StampJoiner, nanoseconds

KEYS = "abc"


@st.composite
def streams_in_order(draw):
    """Arrivals (key, stamp) of sources whose own stamps rise, interleaved at random, some messages lost."""
    stamps = {key: sorted(draw(st.sets(st.integers(0, 30)))) for key in KEYS}
    order = draw(st.permutations([key for key, values in stamps.items() for _ in values]))
    return [(key, stamps[key].pop(0)) for key in order]


def feed(joiner, arrivals):
    """Stamps of the sets given out; every part carries the stamp and source that it came with."""
    given_out = []
    for key, stamp in arrivals:
        parts = joiner.add(key, stamp, (key, stamp))
        if parts is not None:
            assert {name: part[0] for name, part in parts.items()} == {name: name for name in KEYS}
            instants = {part[1] for part in parts.values()}
            assert len(instants) == 1
            given_out += instants
    return given_out


@given(streams_in_order())
def test_gives_out_exactly_the_instants_that_all_have(arrivals):
    common = set.intersection(*({stamp for key, stamp in arrivals if key == name} for name in KEYS))
    joiner = StampJoiner(KEYS)
    assert feed(joiner, arrivals) == sorted(common)
    stamps = {stamp for _, stamp in arrivals}
    assert joiner.waiting == len({stamp for stamp in stamps if stamp > max(common, default=-1)})
    assert joiner.incomplete + joiner.waiting == len(stamps - common)
    assert joiner.late == joiner.repeated == 0


@given(st.lists(st.tuples(st.sampled_from(KEYS), st.integers(0, 12))))
def test_any_arrivals_keep_instants_apart(arrivals):
    feed(StampJoiner(KEYS), arrivals)


@st.composite
def two_runs(draw):
    """Arrivals (key, stamp, run): every source ends one run and starts the next at a stamp that it had passed."""
    sent = {}
    for key in KEYS:
        first = sorted(draw(st.sets(st.integers(1, 12), min_size=1)))
        second = sorted(draw(st.sets(st.integers(0, 12))) | {draw(st.integers(0, first[-1] - 1))})
        sent[key] = [(key, stamp, 1) for stamp in first] + [(key, stamp, 2) for stamp in second]
    received = [sent[key].pop(0) for key in KEYS]
    order = draw(st.permutations([key for key, messages in sent.items() for _ in messages]))
    return received + [sent[key].pop(0) for key in order]


@given(two_runs())
def test_two_runs_are_never_mixed(arrivals):
    joiner = StampJoiner(KEYS)
    for key, stamp, run in arrivals:
        parts = joiner.add(key, stamp, run)
        assert parts is None or len(set(parts.values())) == 1


def test_run_that_starts_again_after_a_source_died():
    joiner = StampJoiner((1, 2))
    sets = [
        joiner.add(key, stamp, run)
        for run, died in (("run1", 8), ("run2", 99))
        for stamp in range(12)
        for key in (1, 2)
        if key == 1 or stamp < died
    ]
    given_out = [parts for parts in sets if parts]
    assert given_out == [{1: "run1", 2: "run1"}] * 8 + [{1: "run2", 2: "run2"}] * 12
    assert joiner.incomplete == 4


def test_source_that_did_not_go_back_is_of_the_new_run_once_past_the_old_one():
    joiner = StampJoiner("ab", restart_gap=10)
    feed_pairs(joiner, [5])
    joiner.add("a", 2, None)
    assert feed_pairs(joiner, [9, 15, 16]) == [16]
    assert joiner.late == 2


def test_withdrawn_message_is_not_given_out_again():
    joiner = StampJoiner("ab")
    message = object()
    joiner.add("a", 3, message)
    assert not joiner.withdraw("a", 3, object())
    assert joiner.withdraw("a", 3, message)
    assert joiner.waiting == 0
    assert joiner.add("b", 3, None) is None
    assert joiner.late == 1


@given(st.lists(st.tuples(st.sampled_from(KEYS), st.integers(0, 1000))), st.integers(1, 5))
def test_is_bounded(arrivals, capacity):
    joiner = StampJoiner(KEYS, capacity)
    for key, stamp in arrivals:
        joiner.add(key, stamp, None)
        assert joiner.waiting <= capacity


def test_repeated_message_is_counted_and_the_first_used():
    joiner = StampJoiner(KEYS)
    joiner.add("a", 1, "first")
    joiner.add("a", 1, "second")
    joiner.add("b", 1, "b")
    assert joiner.add("c", 1, "c") == {"a": "first", "b": "b", "c": "c"}
    assert joiner.repeated == 1


def test_sources_that_go_back_in_time_start_again():
    joiner = StampJoiner("ab", restart_gap=10)
    assert feed_pairs(joiner, [100, 101, 50, 51]) == [100, 101, 50, 51]


def test_every_loss_is_reported_with_its_stamp_and_sources():
    output = []
    joiner = StampJoiner(KEYS, on_loss=lambda *loss: output.append(loss))
    for key, stamp in [("a", 1), ("a", 1), ("a", 2), ("b", 2), ("c", 2), ("b", 2)]:
        joiner.add(key, stamp, None)
    assert output == [
        (Loss.REPEATED, 1, {"a"}),
        (Loss.INCOMPLETE, 1, {"b", "c"}),
        (Loss.LATE, 2, {"b"}),
    ]


def test_stamp_in_nanoseconds():
    assert nanoseconds(SimpleNamespace(sec=3, nanosec=7)) == 3_000_000_007


def feed_pairs(joiner, stamps):
    given_out = []
    for stamp in stamps:
        joiner.add("a", stamp, None)
        if joiner.add("b", stamp, None) is not None:
            given_out.append(stamp)
    return given_out
