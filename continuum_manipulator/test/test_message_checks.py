"""Checks of messages: what is refused, by which cause, and that the offending value is named."""

import math

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, Vector3
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.faults import MessageFault

FINITE = st.floats(-1e3, 1e3)


def fault(check, *arguments, **options):
    with pytest.raises(MessageFault) as caught:
        check(*arguments, **options)
    return caught.value


@given(st.lists(FINITE, min_size=1), st.sampled_from([math.nan, math.inf, -math.inf]), st.data())
def test_one_bad_number_is_found(values, bad, data):
    place = data.draw(st.integers(0, len(values) - 1))
    values[place] = bad
    error = fault(messages.finite, "position", values)
    assert error.cause == messages.NOT_FINITE
    assert f"position[{place}]" in error.detail


@given(st.lists(FINITE))
def test_finite_numbers_pass(values):
    assert messages.finite("position", values).tolist() == values


@pytest.mark.parametrize("axis", "xyz")
def test_vector_names_its_axis(axis):
    assert f"linear.{axis} is nan" in fault(messages.finite_vector, "linear", Vector3(**{axis: math.nan})).detail


@given(st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(lambda q: np.linalg.norm(q) > 1e-3), st.floats(0.1, 9))
def test_z_axis_is_that_of_the_rotation_whatever_the_norm(parts, scale):
    parts = scale * np.array(parts)
    quaternion = Quaternion(**dict(zip("xyzw", parts.tolist(), strict=True)))
    expected = Rotation.from_quat(parts).as_matrix()[:, 2]
    np.testing.assert_allclose(messages.z_axis("orientation", quaternion), expected, atol=1e-12)


@pytest.mark.parametrize(
    ("parts", "cause"), [((0.0, 0.0, 0.0, 0.0), messages.NO_ROTATION), ((math.nan, 0.0, 0.0, 1.0), messages.NOT_FINITE)]
)
def test_quaternion_that_is_no_rotation(parts, cause):
    quaternion = Quaternion(**dict(zip("xyzw", parts, strict=True)))
    assert fault(messages.z_axis, "orientation", quaternion).cause == cause


@pytest.mark.parametrize(("length", "optional"), [(1, False), (0, False), (3, True)])
def test_wrong_length(length, optional):
    error = fault(messages.same_length, "velocity", [0.0] * length, ["a", "b"], optional)
    assert error.cause == messages.WRONG_LENGTH
    assert f"has {length} entries" in error.detail


def test_unknown_may_be_empty():
    messages.same_length("velocity", [], ["a", "b"], optional=True)


@given(st.permutations(["a", "b", "c", "d"]))
def test_names_are_found_wherever_they_stand(names):
    assert [names[i] for i in messages.indices_of(["b", "d"], names)] == ["b", "d"]


def test_missing_and_repeated_names():
    assert fault(messages.indices_of, ["a", "b"], ["a"]).cause == messages.MISSING_NAME
    assert fault(messages.indices_of, ["a"], ["a", "a"]).cause == messages.REPEATED_NAME


def test_names_that_are_not_there_are_listed():
    error = fault(messages.named, [], "cables", ["a", "b"])
    assert (error.cause, error.detail) == (messages.MISSING_NAME, "name is empty; list the cables: a, b")
    messages.named(["x"], "cables", ["a", "b"])


def test_an_unknown_name_is_named_with_the_nearest_known_one():
    known = ["section_1_phi", "section_1_theta_1", "section_2_phi"]
    assert "did you mean section_1_theta_1?" in fault(messages.no_others, known, ["section_1_thetta_1"]).detail
    assert fault(messages.no_others, ["a", "b"], ["elbow"]).detail == "elbow; known: a, b"
    detail = fault(messages.indices_of, known, [*known[:2], "section2_phi"]).detail
    assert detail == "section_2_phi not in the message; it has section2_phi; did you mean section_2_phi?"
    near, far = (messages.nothing_known("joint", names, known).detail for names in (["sektion_1_phi"], ["elbow"]))
    assert "did you mean section_1_phi" in near
    assert far == messages.nothing_known("joint", [], known).detail == "no joint of this arm is in the message"


@given(st.integers(0, 9), st.integers(0, 9))
def test_only_a_stamp_of_zero_is_none(sec, nanosec):
    stamp = Time(sec=sec, nanosec=nanosec)
    if sec == nanosec == 0:
        assert fault(messages.stamped, stamp).cause == messages.NO_STAMP
    else:
        messages.stamped(stamp)


@pytest.mark.parametrize("name", ["", "base_link"])
def test_frame(name):
    messages.frame("frame_id", name, "base_link")
    assert fault(messages.frame, "frame_id", "world", "base_link").cause == messages.WRONG_FRAME
