"""Markers over DDS, and a node's parameters as ROS tools see them."""

import shlex

import numpy as np
import pytest
import yaml
from arm_messages import ARM, instant_of, joint_state, postures
from harness import ARM_FILE, NodeProcess, Probe, running
from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParameters
from sensor_msgs.msg import JointState
from visualization_msgs.msg import Marker, MarkerArray

from continuum.cable_colours import cable_colour
from continuum.kinematics.cable_lines import cable_lines
from continuum.kinematics.configuration import allen_from_jones
from continuum.kinematics.discs import even_bends
from continuum_manipulator.nodekit.qos import REPORT
from continuum_manipulator.section_joints import joint_names

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def probe(domain):
    node = NodeProcess("continuum_manipulator", "markers", domain, files=(ARM_FILE,), parameters={"rate": 1000.0})
    with running(node), Probe(domain) as probe:
        yield probe


def test_markers_show_cables_and_curvature(probe):
    cables = probe.hear(MarkerArray, "cable_markers", REPORT)
    arrows = probe.hear(MarkerArray, "section_config_markers", REPORT)
    say = probe.speaker(JointState, "joint_states").publish
    w = postures(1)[0][0].copy()
    w[1] = 0.0
    probe.warm_up(lambda: say(joint_state(0, w)), cables, arrows)
    say(joint_state(1, w))
    probe.wait_until(lambda: cables and arrows, "markers")
    lines = cable_lines([even_bends(bent, section) for bent, section in zip(w, ARM.sections, strict=True)], ARM)
    assert len(cables[0].markers) == len(lines) == 12 + 8 + 4
    np.testing.assert_allclose(points_of(cables[0]), [line.points for line in lines], atol=1e-12)
    for marker, line in zip(cables[0].markers, lines, strict=True):
        assert marker.header.frame_id == "base_link"
        assert instant_of(marker) == 1
        np.testing.assert_allclose(
            [marker.color.r, marker.color.g, marker.color.b], cable_colour(line.colour_index), atol=1e-6
        )
    own, passing = (
        {m.scale.x for m, line in zip(cables[0].markers, lines, strict=True) if line.passing is p}
        for p in (False, True)
    )
    assert max(passing) < min(own)
    assert [marker.action for marker in arrows[0].markers] == [Marker.ADD, Marker.DELETE, Marker.ADD]
    assert len({(marker.ns, marker.id) for marker in cables[0].markers + arrows[0].markers}) == 24 + 3


def test_cables_go_by_the_angle_of_every_joint(probe):
    """As the links do in RViz: robot_state_publisher lets a joint that is published follow no other."""
    cables = probe.hear(MarkerArray, "cable_markers", REPORT)
    say = probe.speaker(JointState, "joint_states").publish
    w = postures(1)[0][0]
    probe.warm_up(lambda: say(joint_state(0, w)), cables)
    message = joint_state(1, w)
    rng = np.random.default_rng(3)
    bends = []
    for section in ARM.sections:
        angles = rng.uniform(-0.3, 0.4, section.n_joints)
        for name, angle in zip(section.theta_joints, angles, strict=True):
            message.position[message.name.index(name)] = angle
        bends.append(allen_from_jones(message.position[message.name.index(section.phi_joint)], angles))
    say(message)
    probe.wait_until(lambda: cables and instant_of(cables[-1].markers[0]) == 1, "markers")
    lines = cable_lines(bends, ARM)
    np.testing.assert_allclose(points_of(cables[-1]), [line.points for line in lines], atol=1e-12)


def points_of(markers: MarkerArray) -> list[list[tuple[float, float, float]]]:
    return [[(point.x, point.y, point.z) for point in marker.points] for marker in markers.markers]


@pytest.fixture(scope="module")
def slow(domain):
    """Draws twice a second, in a namespace: the other node would draw everything."""
    namespace = ("--ros-args", "-r", "__ns:=/slow", "--")
    node = NodeProcess(
        "continuum_manipulator", "markers", domain, files=(ARM_FILE,), parameters={"rate": 2.0}, arguments=namespace
    )
    with running(node), Probe(domain, "burst") as probe:
        yield probe


def test_last_bend_of_every_section_is_drawn_where_each_has_a_message(slow):
    markers = slow.hear(MarkerArray, "slow/cable_markers", REPORT)
    say = slow.speaker(JointState, "slow/joint_states").publish
    bends, _ = postures(10)
    slow.warm_up(lambda: say(joint_state(0, bends[0])), markers)
    for i, w in enumerate(bends):
        whole = joint_state(i, w)
        angles = dict(zip(whole.name, whole.position, strict=True))
        for section in ARM.sections:
            names = joint_names(section)
            say(JointState(header=whole.header, name=names, position=[angles[name] for name in names]))
    last = [even_bends(bent, section) for bent, section in zip(bends[-1], ARM.sections, strict=True)]
    expected = [line.points for line in cable_lines(last, ARM)]

    def drawn():
        return markers and all(map(np.allclose, points_of(markers[-1]), expected))

    slow.wait_until(drawn, "markers of the last bend of every section")


def ask(probe, service_type, service, **fields):
    client = probe.node.create_client(service_type, f"markers/{service}")
    probe.wait_until(client.service_is_ready, service)
    future = client.call_async(service_type.Request(**fields))
    probe.wait_until(future.done, f"answer of {service}")
    return future.result()


def test_parameters_have_description_type_and_range(probe):
    names = ["rate", "arm.section_2.a", "arm.section_1.n_joints", "arm.section_3.bend_limit", "arm.sections"]
    rate, radius, n_joints, limit, sections = ask(
        probe, DescribeParameters, "describe_parameters", names=names
    ).descriptors
    assert "radius of the cables' holes" in radius.description
    assert radius.description.endswith("[m]")
    assert radius.type == ParameterType.PARAMETER_DOUBLE
    assert radius.floating_point_range[0].to_value == 10.0
    assert n_joints.type == ParameterType.PARAMETER_INTEGER
    assert n_joints.integer_range[0].from_value == 1
    assert sections.type == ParameterType.PARAMETER_STRING_ARRAY
    assert all(d.read_only and d.description and d.additional_constraints for d in (rate, radius, n_joints, limit))
    values = ask(probe, GetParameters, "get_parameters", names=names).values
    assert values[1].double_value == ARM.sections[1].a
    assert values[3].double_value == ARM.sections[2].bend_limit  # a default, not in the file


def test_parameters_do_not_change_after_the_start(probe):
    value = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=5.0)
    (result,) = ask(probe, SetParameters, "set_parameters", parameters=[Parameter(name="rate", value=value)]).results
    assert not result.successful
    assert "read-only" in result.reason
    name, given = shlex.split(result.reason)[-1].split(":=")  # the option that starts the node with it
    assert (name, yaml.safe_load(given)) == ("rate", 5.0)
