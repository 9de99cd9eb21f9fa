"""Names, limits and mimic structure of the joints."""

import inspect
import math
import sys

import pytest
from description_model import Description, arms
from hypothesis import given, settings

from continuum.arm import Arm, Section
from continuum.urdf.robot import robot_urdf

pytestmark = pytest.mark.slow


def check_bending_joints(description: Description, section: Section) -> None:
    limit = section.bend_limit / section.n_joints
    for k, name in enumerate(section.theta_joints):
        joint = description.joints[name]
        assert joint.type == "revolute"
        assert (joint.limit.lower, joint.limit.upper) == pytest.approx((-limit, limit), rel=1e-12)
        assert min(joint.limit.velocity, joint.limit.effort) > 0
        if k == 0:
            assert joint.mimic is None
        else:
            assert (joint.mimic.joint, joint.mimic.multiplier) == (section.theta_joints[0], 1.0)


def check_turning_joints(description: Description, section: Section) -> None:
    back = [section.phi_back_joint] + [f"{section.name}_disc_{k}_joint" for k in range(1, section.n_joints)]
    for name in [section.phi_joint, *back]:
        joint = description.joints[name]
        assert joint.type == "revolute"
        assert (joint.limit.lower, joint.limit.upper) == pytest.approx((-math.pi, math.pi), rel=1e-12)
        assert min(joint.limit.velocity, joint.limit.effort) > 0
    assert description.joints[section.phi_joint].mimic is None
    for name in back:
        mimic = description.joints[name].mimic
        assert (mimic.joint, mimic.multiplier) == (section.phi_joint, -1.0)


def check_structure(description: Description) -> None:
    arm = description.arm
    free = [name for section in arm.sections for name in (section.phi_joint, section.theta_joints[0])]
    assert sorted(description.urdf.actuated_joint_names) == sorted(free)
    assert description.urdf.base_link == "base_link"
    children = [joint.child for joint in description.joints.values()]
    assert sorted([*children, "base_link"]) == sorted(description.links)
    parents = ["base_link"] + [section.tip_frame for section in arm.sections[:-1]]
    for section, parent in zip(arm.sections, parents, strict=True):
        base = description.joints[f"{section.name}_base_joint"]
        assert (base.type, base.parent, base.child) == ("fixed", parent, section.base_frame)
        check_bending_joints(description, section)
        check_turning_joints(description, section)


@settings(max_examples=10, deadline=None)
@given(arms())
def test_structure_of_any_arm(arm: Arm) -> None:
    check_structure(Description(arm))


def test_many_joints_need_no_deep_recursion() -> None:
    section = Section("long", n_joints=100, b=0.001, a=0.005)
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(len(inspect.stack()) + 200)
    try:
        joints = {joint.get("name") for joint in robot_urdf(Arm((section,))).iter("joint")}
    finally:
        sys.setrecursionlimit(limit)
    assert {section.phi_joint, *section.theta_joints, section.phi_back_joint} <= joints
