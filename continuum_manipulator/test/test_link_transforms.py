"""Transforms of a description: those of an independent reader, for any arm, posture and sensor."""

import io

import numpy as np
import pytest
import yourdfpy
from builtin_interfaces.msg import Time
from frame_tree import FrameTree
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from continuum.arm import Arm, Section
from continuum.errors import InvalidValueError
from continuum.urdf.robot import Sensor, urdf_text
from continuum_manipulator.link_transforms import LinkTransforms

JOINT = '<joint name="j" type="{}"><parent link="a"/><child link="b"/>{}</joint>'


@settings(max_examples=10)
@given(st.integers(0, 2**32 - 1), st.booleans())
def test_every_link_is_where_yourdfpy_has_it(seed, single_bends):
    """Joints that mimic another one follow it, unless their own angles are given."""
    random = np.random.default_rng(seed)
    arm = Arm(
        tuple(
            Section(f"s_{i}", n_joints=int(random.integers(1, 5)), b=0.02, a=0.03, twist=random.uniform(-6, 6),
                    bend_limit=1.0)
            for i in range(random.integers(1, 4))
        )
    )  # fmt: skip
    sensors = [
        Sensor(f"sensor_{i}", section.tip_frame, Rotation.random(random_state=random).as_matrix())
        for i, section in enumerate(arm.sections)
    ]
    text = urdf_text(arm, sensors)
    reader = yourdfpy.URDF.load(io.BytesIO(text.encode()), load_meshes=False)
    phi, theta = random.uniform(-3, 3, arm.n_sections), random.uniform(-1, 1, arm.n_sections)
    free = {section.phi_joint: phi[i] for i, section in enumerate(arm.sections)}
    free |= {section.theta_joints[0]: theta[i] / section.n_joints for i, section in enumerate(arm.sections)}
    reader.update_cfg(free)
    given_angles = dict(free)
    if single_bends:
        for i, section in enumerate(arm.sections):
            given_angles |= dict.fromkeys(section.theta_joints, theta[i] / section.n_joints)
    links, stamp = LinkTransforms(text, "its/"), Time(sec=7)
    moved = links.moved(given_angles, stamp)
    assert {(one.header.stamp.sec, one.header.frame_id[:4]) for one in moved.transforms} == {(7, "its/")}
    tree = FrameTree([*links.fixed.transforms, *moved.transforms])
    assert tree.roots() == {"its/base_link"}
    assert tree.frames == {f"its/{link.name}" for link in reader.robot.links}
    for link in reader.robot.links:
        expected = reader.get_transform(link.name, "base_link")
        np.testing.assert_allclose(tree.pose(f"its/{link.name}"), expected, atol=1e-7)  # its smallest rotation: 1e-8


def test_an_angle_of_its_own_counts_more_than_that_of_the_mimicked_joint():
    """Both come on top of the turn that the joint has at angle 0."""
    rest = '<origin rpy="0 0 0.4"/><axis xyz="0 0 2"/>'
    follower = JOINT.format("revolute", f'{rest}<mimic joint="other" multiplier="-2" offset="0.1"/>')
    links = LinkTransforms(f"<robot>{follower}</robot>")

    def angle(**angles: float) -> float:
        (one,) = links.moved(angles, Time()).transforms
        return 2 * np.arctan2(one.transform.rotation.z, one.transform.rotation.w)

    assert angle(other=0.3) == pytest.approx(0.4 - 0.5)
    assert angle(other=0.3, j=0.2) == pytest.approx(0.4 + 0.2)
    assert links.moved({"third": 1.0}, Time()).transforms == []


@pytest.mark.parametrize(
    "text",
    [
        "no URDF", "<robot>", f"<robot>{JOINT.format('prismatic', '')}</robot>",
        f"<robot>{JOINT.format('fixed', '<origin rpy=\"0 0\"/>')}</robot>",
        f"<robot>{JOINT.format('fixed', '<origin xyz=\"0 0 nan\"/>')}</robot>", '<robot><joint type="fixed"/></robot>',
    ],
)  # fmt: skip
def test_another_text_is_refused(text):
    with pytest.raises(InvalidValueError, match="robot_description"):
        LinkTransforms(text)
