"""Plain data into messages and back."""

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovariance
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import JointState
from std_msgs.msg import Int8, UInt8
from visualization_msgs.msg import Marker

from ros2_standin.errors import UserError
from ros2_standin.interface_types import message_class, service_class
from ros2_standin.message_fields import fill_message
from ros2_standin.message_text import Shortening, csv_text, pick, plain, yaml_text
from ros2_standin.topic_pub import message_values

_FLOATS = st.lists(st.floats(allow_nan=False), max_size=4)
_TEXT = st.text(st.characters(codec="utf-8", exclude_characters="\0"))


@given(_FLOATS, st.lists(_TEXT, max_size=3), st.integers(-(2**31), 2**31 - 1), _TEXT)
def test_a_message_survives_its_yaml(position, name, sec, frame) -> None:
    message = JointState(position=position, name=name)
    message.header.stamp.sec = sec
    message.header.frame_id = frame
    copy = JointState()
    assert fill_message(copy, message_values(yaml_text(plain(message)))) == []
    assert copy == message


def test_arrays_sequences_of_messages_and_bytes() -> None:
    marker = Marker()
    fill_message(marker, {"points": [{"x": 1}, {"z": 2.5}], "ns": 5})
    assert marker.points == [Point(x=1.0), Point(z=2.5)]
    assert marker.ns == "5"
    pose = PoseWithCovariance()
    fill_message(pose, {"covariance": list(range(36))})
    assert pose.covariance.tolist() == list(range(36))
    status = DiagnosticStatus()
    fill_message(status, {"level": 2})
    assert status.level == b"\x02"


def test_stamps_are_left_to_the_time_of_publication() -> None:
    pose = PoseStamped()
    (stamp,) = fill_message(pose, {"header": "auto"})
    stamp(message_class("builtin_interfaces/msg/Time")(sec=7))
    assert pose.header.stamp.sec == 7
    (stamp,) = fill_message(pose, {"header": {"stamp": "now", "frame_id": "f"}})
    stamp(message_class("builtin_interfaces/Time")(sec=8))
    assert (pose.header.stamp.sec, pose.header.frame_id) == (8, "f")


@pytest.mark.parametrize(
    ("values", "problem"),
    [
        ({"pos": 1}, "no field 'pos'; allowed: header, pose"),
        ({"pose": {"position": {"w": 1}}}, "no field 'pose.position.w'; allowed: x, y, z"),
        ({"pose": {"position": {"x": "far"}}}, "'pose.position.x' is 'far'; allowed: a number"),
        ({"pose": {"position": {"x": True}}}, "is True; allowed: a number"),
        ({"pose": 1}, "'pose' is 1; allowed: a mapping"),
        ({"header": {"stamp": {"nanosec": -1}}}, "is -1; allowed: a whole number from 0 to 4294967295"),
        ({"header": {"frame_id": [1]}}, "allowed: a text"),
    ],
)
def test_mistakes_name_the_field(values: dict, problem: str) -> None:
    with pytest.raises(UserError, match=problem):
        fill_message(PoseStamped(), values)


@given(st.integers())
def test_whole_numbers_keep_to_their_range(value: int) -> None:
    for kind, low, high in ((Int8, -128, 127), (UInt8, 0, 255)):
        message = kind()
        if low <= value <= high:
            fill_message(message, {"data": value})
            assert message.data == value
        else:
            with pytest.raises(UserError, match=f"from {low} to {high}"):
                fill_message(message, {"data": value})


def test_wrong_sizes_are_refused() -> None:
    with pytest.raises(UserError, match="a list of 36"):
        fill_message(PoseWithCovariance(), {"covariance": [1.0]})
    with pytest.raises(UserError, match="'position' is 1; allowed: a list"):
        fill_message(JointState(), {"position": 1})


@pytest.mark.parametrize("text", ["a", "[1]", "{", "3"])
def test_values_must_be_a_mapping(text: str) -> None:
    with pytest.raises(UserError):
        message_values(text)


@pytest.mark.parametrize(
    "name", ["nix/msg/String", "std_msgs/msg/Nix", "std_msgs", "std_msgs/srv/String", "../x/y", "a.b/c"]
)
def test_unknown_types_are_refused(name: str) -> None:
    with pytest.raises(UserError, match="type"):
        message_class(name)


def test_types_are_found() -> None:
    assert message_class("geometry_msgs/Point") is Point
    assert service_class("std_srvs/srv/Empty").Request is not None


def test_texts_are_shortened_as_asked() -> None:
    message = JointState(name=["a" * 9], position=[1.0, 2.0, 3.0])
    assert plain(message, Shortening(longest=2))["position"] == [1.0, 2.0, "..."]
    assert plain(message, Shortening(longest=2))["name"] == ["aa..."]
    assert plain(message, Shortening(no_arrays=True))["position"] == "<sequence type: double, length: 3>"
    assert csv_text(plain(Point(x=1.0, y=2.0))) == "1.0,2.0,0.0"
    assert pick(message, ["header", "stamp", "sec"]) == 0
    with pytest.raises(UserError, match="no 'nix' in header"):
        pick(message, ["header", "nix"])
