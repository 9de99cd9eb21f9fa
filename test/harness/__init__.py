"""Real node processes, and a probe that talks to them, for tests."""

from harness.node_process import ARM_FILE, NodeProcess, ended_in_any_case, running
from harness.probe import Probe
from harness.waiting import wait_until

__all__ = ["ARM_FILE", "NodeProcess", "Probe", "ended_in_any_case", "running", "wait_until"]
