"""Real node processes, and a probe that talks to them, for tests."""

from harness.node_process import ARM_FILE, NodeProcess, running
from harness.probe import Probe
from harness.waiting import wait_until

__all__ = ["ARM_FILE", "NodeProcess", "Probe", "running", "wait_until"]
