"""A launch file for fewer sections than the arm has: the tangler tells it before poses come, and only then."""

from dataclasses import replace

import pytest
import rclpy
import yaml
from arm_messages import ARM, cables, postures
from harness import ARM_FILE, Probe
from rclpy.experimental import EventsExecutor

from continuum.arm import Arm, arm_to_mapping
from continuum.kinematics.routing import cables_through, section_lengths
from continuum_manipulator.cable_tangler import CableTanglerNode
from continuum_manipulator.nodekit.qos import STREAM
from continuum_msgs.msg import CableStates

pytestmark = pytest.mark.ros


@pytest.fixture(params=[3, 4])
def arm_file(request, tmp_path):
    """The file of an arm of so many sections."""
    if request.param == 3:
        return ARM_FILE
    sections = (*ARM.sections, replace(ARM.sections[-1], name="section_4"))
    longer = tmp_path / "arm.yaml"
    longer.write_text(yaml.safe_dump({"/**": {"ros__parameters": {"arm": arm_to_mapping(Arm(sections))}}}))
    return longer


def test_sections_for_which_nobody_speaks_are_reported(arm_file, domain):
    """One who speaks for three sections is enough for an arm of three, not for one of four."""
    rclpy.init(args=["--ros-args", "--params-file", str(arm_file)], domain_id=domain)
    try:
        with Probe(domain) as probe:
            publisher = probe.node.create_publisher(CableStates, "section_cable_states", STREAM)
            node = CableTanglerNode()
            probe.wait_until(publisher.get_subscription_count, "the tangler")
            (w,), _ = postures(1)
            for i in range(ARM.n_sections):
                publisher.publish(cables(0, i + 1, cables_through(ARM, i).names, section_lengths(w[i], ARM, i)))
            assert publisher.wait_for_all_acked()
            executor = EventsExecutor()
            executor.add_node(node)
            received = node.diagnostics.received
            probe.wait_until(
                lambda: (executor.spin_once(timeout_sec=0.01), received["section_cable_states"] == ARM.n_sections)[1],
                "the sections' states",
            )
            node._patience_timer.callback()
            expected = ["sections without a node"] if arm_file != ARM_FILE else []
            assert list(node.diagnostics.warnings.counts) == expected
            executor.remove_node(node)
            node.destroy_node()
    finally:
        rclpy.shutdown()
