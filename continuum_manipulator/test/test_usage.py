"""``--help`` of every node: its parameters with meaning, range and default, and exit code 0."""

import importlib
import subprocess
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_prefix
from harness.waiting import LONG

from continuum.arm import SECTION_PARAMETERS
from continuum_manipulator.nodekit.usage import usage

NODES = ("section", "robot", "dynamics", "cable_tangler", "markers", "recorder", "viewer")


@pytest.mark.parametrize("word", ["--help", "-h"])
def test_help_is_printed_and_is_no_error(word):
    program = Path(get_package_prefix("continuum_manipulator")) / "lib" / "continuum_manipulator" / "section"
    result = subprocess.run([str(program), word], capture_output=True, text=True, timeout=LONG, check=False)
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.startswith(
        "usage: ros2 run continuum_manipulator section --ros-args --params-file ARM.yaml -p "
    )
    assert "number of the node's section, 1 at the base; a whole number >= 1; required" in result.stdout
    assert "take the time from /clock; true or false; default false" in result.stdout


@pytest.mark.parametrize("name", NODES)
def test_every_parameter_is_listed(name):
    module = importlib.import_module(f"continuum_manipulator.{name}")
    (node_class,) = (kind for kind in vars(module).values() if getattr(kind, "NAME", None) == name)
    words = " ".join(usage(node_class).split())
    for spec in node_class.PARAMETERS:
        assert f" {spec.name} {spec.description}; {spec.allowed}; " in words
    for spec in SECTION_PARAMETERS:
        assert (f" arm.<section>.{spec.name} {spec.description}; " in words) == node_class.HAS_ARM
