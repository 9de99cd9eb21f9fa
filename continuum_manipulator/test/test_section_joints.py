"""Joints of a section to its configuration and back, and what of a message is refused."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import JointState

from continuum.arm import Section
from continuum.kinematics.configuration import allen_from_jones, allen_rates
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.section_joints import (
    Configuration,
    joint_names,
    joint_values,
    read_bends,
    read_joints,
    read_names,
)

SECTION = Section("s", n_joints=4, b=0.02, a=0.03)
NAMES = joint_names(SECTION)
ANGLE = st.floats(-3.0, 3.0)
RATE = st.floats(-5.0, 5.0)


def read(names, positions, velocities=()):
    return read_joints({name: i for i, name in enumerate(names)}, positions, velocities, SECTION)


@given(ANGLE, ANGLE, RATE, RATE)
def test_joints_carry_configuration_and_rate(u, v, u_rate, v_rate):
    state = Configuration(np.array([u, v]), np.array([u_rate, v_rate]))
    again = read(NAMES, *joint_values(state, SECTION))
    np.testing.assert_allclose(again.w, state.w, atol=2e-12)
    np.testing.assert_allclose(again.rate, state.rate, atol=1e-9)


@given(RATE, RATE)
def test_straight_section_keeps_its_rate(u_rate, v_rate):
    state = Configuration(np.zeros(2), np.array([u_rate, v_rate]))
    again = read(NAMES, *joint_values(state, SECTION))
    np.testing.assert_allclose(again.w, 0.0, atol=1e-15)
    np.testing.assert_allclose(again.rate, state.rate, atol=1e-12)


def test_unknown_rate_stays_unknown():
    positions, velocities = joint_values(Configuration(np.array([0.3, 0.1]), None), SECTION)
    assert velocities is None
    assert read(NAMES, positions).rate is None


@given(st.floats(-3, 3), st.lists(st.floats(-0.5, 0.5), min_size=4, max_size=4))
def test_bend_is_the_sum_of_unequal_joints(phi, thetas):
    state = read([SECTION.phi_joint, *SECTION.theta_joints], [phi, *thetas], [0.7, *thetas])
    np.testing.assert_allclose(state.w, allen_from_jones(phi, sum(thetas)), atol=1e-12)
    np.testing.assert_allclose(state.rate, allen_rates(phi, sum(thetas), 0.7, sum(thetas)), atol=1e-12)


@given(st.floats(-3, 3), st.lists(st.floats(-0.5, 0.5), min_size=4, max_size=4))
def test_bends_are_those_of_the_joints(phi, thetas):
    names = [SECTION.phi_joint, *SECTION.theta_joints]
    bends = read_bends({name: i for i, name in enumerate(names)}, [phi, *thetas], SECTION)
    np.testing.assert_allclose(bends, [allen_from_jones(phi, theta) for theta in thetas], atol=1e-15)


def test_bends_of_joints_that_follow_are_those_of_the_first():
    bends = read_bends({SECTION.phi_joint: 0, SECTION.theta_joints[0]: 1}, [0.2, 0.1], SECTION)
    np.testing.assert_allclose(bends, [allen_from_jones(0.2, 0.1)] * SECTION.n_joints)


def test_first_joint_leads_the_others():
    state = read([SECTION.theta_joints[0], SECTION.phi_joint], [0.1, 0.2])
    np.testing.assert_allclose(state.w, allen_from_jones(0.2, 0.4))


def test_joints_of_others_are_not_ours():
    assert read(["gripper"], [1.0]) is None


@pytest.mark.parametrize(
    "left_out",
    [{SECTION.phi_joint}, {SECTION.theta_joints[2]}, set(SECTION.theta_joints), {SECTION.theta_joints[0]}],
)
def test_missing_joints_are_named(left_out):
    names = [name for name in NAMES if name not in left_out]
    with pytest.raises(MessageFault) as caught:
        read(names, [0.0] * len(names))
    assert caught.value.cause == messages.MISSING_NAME
    assert all(name in caught.value.detail for name in left_out)


@pytest.mark.parametrize("bad", [math.nan, math.inf])
@pytest.mark.parametrize("joint", [SECTION.phi_joint, SECTION.theta_joints[3]])
def test_bad_numbers_are_refused_and_named(joint, bad):
    values = [bad if name == joint else 0.1 for name in NAMES]
    with pytest.raises(MessageFault, match=f"not finite: position of {joint}"):
        read(NAMES, values)
    with pytest.raises(MessageFault, match=f"not finite: velocity of {joint}"):
        read(NAMES, [0.1] * len(NAMES), values)


@pytest.mark.parametrize("side", [1, -1])
def test_bend_beyond_the_contact_of_the_discs_is_refused(side):
    theta = side * 1.01 * SECTION.contact_bend
    with pytest.raises(MessageFault) as caught:
        read(NAMES, [0.0, *[theta / 4] * 4, 0.0])
    assert caught.value.cause == messages.REFUSED


@pytest.mark.parametrize(
    ("fields", "cause"),
    [
        ({"position": [0.1]}, messages.WRONG_LENGTH),
        ({"velocity": [0.1]}, messages.WRONG_LENGTH),
        ({"effort": [0.1]}, messages.WRONG_LENGTH),
        ({"velocity": [0.1, math.inf]}, messages.NOT_FINITE),
        ({"effort": [math.nan, 0.1]}, messages.NOT_FINITE),
        ({"name": ["a", "a"]}, messages.REPEATED_NAME),
    ],
)
def test_arrays_fit_the_names_and_each_name_stands_once(fields, cause):
    right = {"name": ["a", "b"], "position": [0.1, 0.2]}
    assert read_names(JointState(**right)) == {"a": 0, "b": 1}
    with pytest.raises(MessageFault) as caught:
        read_names(JointState(**(right | fields)))
    assert caught.value.cause == cause
