"""Tension commands by name; whatever a message holds, it is read as finite tensions >= 0 or refused by its cause."""

import math

import pytest
from builtin_interfaces.msg import Time
from hypothesis import given
from hypothesis import strategies as st

from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.nodekit.tension_commands import held_for, read_tensions
from continuum_msgs.msg import CableStates

CABLES = ("left", "right")
NOW = 100 * 10**9


def command(name=CABLES, effort=(1.0, 2.0), age: float = 0.0, **fields) -> CableStates:
    sec, nanosec = divmod(NOW - round(age * 1e9), 10**9)
    message = CableStates(name=list(name), effort=list(effort), **fields)
    message.header.stamp = Time(sec=sec, nanosec=nanosec)
    return message


def test_cables_are_found_by_name():
    assert read_tensions(command(), CABLES, NOW, 0.5).tolist() == [1.0, 2.0]
    assert read_tensions(command(CABLES[::-1]), CABLES, NOW, 0.5).tolist() == [2.0, 1.0]


def test_a_recorded_state_is_a_command():
    assert read_tensions(command(position=[0.2, 0.2], velocity=[0.0, 0.1]), CABLES, NOW, 0.5).tolist() == [1.0, 2.0]


BAD = {
    "NaN": (command(effort=[math.nan, 1.0]), "not finite"),
    "infinite": (command(effort=[1.0, math.inf]), "not finite"),
    "push": (command(effort=[1.0, -0.1]), "value out of range: effort of right is -0.1; a cable pulls: >= 0 N"),
    "too few": (command(effort=[1.0]), "wrong length"),
    "too many": (command(effort=[1.0] * 3), "wrong length"),
    "no tensions": (command(effort=[], position=[0.2, 0.2]), "wrong length"),
    "no names": (command([], []), "missing name: name is empty; list the cables: left, right"),
    "one cable": (command(["left"], [1.0]), "missing name: right not in the message"),
    "misspelt cable": (
        command(["left", "rihgt"]),
        "missing name: right not in the message; it has rihgt; did you mean right?",
    ),
    "foreign cable": (command([*CABLES, "middle"], [1.0] * 3), "unknown name: middle; known: left, right"),
    "one cable twice": (command(["left", "left"]), "repeated name: left"),
    "old": (command(age=0.6), "stale stamp: 0.600 s old on arrival at 100.000000000 s; allowed: 0.5 s"),
    "of the future": (command(age=-0.6), "stale stamp: 0.600 s in the future"),
    "without stamp": (CableStates(name=list(CABLES), effort=[1.0, 2.0]), "no stamp"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_commands_are_refused_by_their_cause(case):
    message, expected = BAD[case]
    with pytest.raises(MessageFault) as caught:
        read_tensions(message, CABLES, NOW, 0.5)
    assert str(caught.value).startswith(expected)


@given(
    st.lists(st.sampled_from([*CABLES, "other", ""]), max_size=4), st.lists(st.floats(), max_size=4), st.floats(-2, 2)
)
def test_what_is_read_is_safe(names, effort, age):
    try:
        tensions = read_tensions(command(names, effort, age), CABLES, NOW, 0.5)
    except MessageFault:
        return
    assert sorted(names) == sorted(CABLES)
    assert abs(age) <= 0.5 + 1e-9
    assert all(math.isfinite(tension) and tension >= 0 for tension in tensions)


def test_good_commands_of_the_last_moment_pass():
    for age in (-0.4, 0.0, 0.49):
        read_tensions(command(age=age), CABLES, NOW, 0.5)


@pytest.mark.parametrize("age", [0.0, 0.3, -0.3])
def test_a_command_holds_from_its_stamp_but_never_from_after_its_arrival(age):
    """Handled 0.1 s after it arrived."""
    late = NOW + 10**8
    assert held_for(command(age=age), NOW, late, 0.5) == pytest.approx(max(age, 0.0) + 0.1)


def test_a_command_that_timed_out_in_the_node_is_dropped_and_the_sender_not_blamed():
    timed_out = NOW + 4 * 10**8
    read_tensions(command(age=0.2), CABLES, NOW, 0.5)
    with pytest.raises(MessageFault, match=r"^handled too late: this node came to it when it was 0.600 s old"):
        held_for(command(age=0.2), NOW, timed_out, 0.5)
