"""A launch file for fewer sections than the arm has: the tangler tells it before poses come, and only then."""

from dataclasses import replace

import pytest
import yaml
from arm_messages import ARM, cables, postures
from harness import ARM_FILE, NodeProcess, Probe, running

from continuum.arm import Arm, arm_to_mapping
from continuum.kinematics.routing import cables_through, section_lengths
from continuum_msgs.msg import CableStates

pytestmark = pytest.mark.ros


def test_sections_for_which_nobody_speaks_are_reported(domain, tmp_path):
    """One who speaks for three sections is enough for an arm of three, not for one of four."""
    longer = tmp_path / "arm.yaml"
    sections = (*ARM.sections, replace(ARM.sections[-1], name="section_4"))
    longer.write_text(yaml.safe_dump({"/**": {"ros__parameters": {"arm": arm_to_mapping(Arm(sections))}}}))
    (w,), _ = postures(1)

    def tangler(name, file) -> NodeProcess:
        return NodeProcess("continuum_manipulator", "cable_tangler", domain, name=name, files=(file,))

    def send() -> None:
        for instant in (0, 1):  # sent again, the first begins a new run: one instant alone is summed once
            for i in range(ARM.n_sections):
                say(cables(instant, i + 1, cables_through(ARM, i).names, section_lengths(w[i], ARM, i)))

    with running(tangler("whole", ARM_FILE)) as (whole,), Probe(domain) as probe:
        totals = probe.hear(CableStates, "cable_states")
        say = probe.speaker(CableStates, "section_cable_states").publish
        probe.warm_up(send, totals)
        with running(tangler("lacking", longer)) as (lacking,):  # later: the other has looked before it does
            lacking.wait_for_line(
                "sections without a node: the arm has 4 sections, publishers on /section_cable_states: 1"
            )
        assert "without a node" not in whole.stderr
