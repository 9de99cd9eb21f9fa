"""How the node starts and ends: wrong parameters, no bench, interrupts; and the page that says what it tells."""

import re
import signal
from pathlib import Path

import numpy as np
import pytest
from harness import NodeProcess, Probe, ended_in_any_case
from lifecycle_msgs.srv import GetState

import continuum_hw_imu
from continuum.inertial.calibration_values import Calibration, save_calibration

pytestmark = pytest.mark.ros

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "bench.md").read_text(encoding="utf-8")
SOURCES = "".join(path.read_text(encoding="utf-8") for path in Path(continuum_hw_imu.__file__).parent.rglob("*.py"))


def bridge(domain: int, **parameters) -> NodeProcess:
    return NodeProcess("continuum_hw_imu", "bench_bridge", domain, parameters=parameters)


@pytest.fixture(scope="module")
def calibration_of_three(tmp_path_factory):
    file = tmp_path_factory.mktemp("sensors") / "three.yaml"
    up, across = np.tile([0.0, 0.0, 9.81], (3, 1)), np.tile([0.0, 1.0, 0.0], (3, 1))
    save_calibration(Calibration(np.zeros((3, 3)), across, up, ("by hand",) * 3), file)
    return file


BAD = {
    "no port": ({}, "port is None; allowed: a text"),
    "simulated time": ({"port": "/dev/null", "use_sim_time": True}, "use_sim_time is True; allowed: false"),
    "tension beyond what the line carries": (
        {"port": "/dev/null", "max_tension": 400.0},
        "max_tension is 400.0; allowed: up to 327.67 N",
    ),
    "a calibration that could not be written": (
        {"port": "/dev/null", "calibration": "/nowhere/sensors.yaml"},
        "calibration is '/nowhere/sensors.yaml'; allowed: a file in a folder that exists",
    ),
    "a model in the place of a calibration": (
        {"port": "/dev/null", "calibration": __file__},
        "test_bench_bridge_start.py",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_parameter_ends_the_node_with_one_line(case, domain):
    parameters, expected = BAD[case]
    with ended_in_any_case(bridge(domain, **parameters)) as (node,):
        assert node.exit_code() == 2
        (line,) = node.stderr.splitlines()
        assert line.startswith("bench_bridge: error: ")
        assert expected in line


def test_calibration_of_another_arm(domain, calibration_of_three):
    with ended_in_any_case(bridge(domain, port="/dev/null", calibration=calibration_of_three)) as (node,):
        assert node.exit_code() == 2
        assert "is 3; allowed: 5, one for each joint of the model" in node.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_without_a_bench_it_waits_says_why_once_and_ends_cleanly(domain, number, tmp_path):
    port = tmp_path / "port"
    with Probe(domain) as probe, ended_in_any_case(bridge(domain, port=port)) as (node,):
        node.wait_for_line(f"waiting: {port} does not exist")
        probe.wait_until(
            lambda: probe.report("bench_bridge: link").get("message") == f"{port} does not exist",
            lambda: probe.report("bench_bridge: link"),
        )
        client = probe.node.create_client(GetState, "bench_bridge/get_state")
        probe.wait_until(client.service_is_ready, "the service")
        answer = client.call_async(GetState.Request())
        probe.wait_until(answer.done, "its answer")
        assert answer.result().current_state.label == "unconfigured"
        assert node.stop(number) == 0
        assert "Traceback" not in node.stderr


@pytest.mark.parametrize("words", re.findall(r"^\| (?:WARN|ERROR|WARN, ERROR) (.+?) \|", PAGE, re.MULTILINE))
def test_what_the_page_explains_is_reported_somewhere(words):
    """Its words, less numbers and names, stand in the sources of the package or of the library's estimator."""
    library = "".join(
        path.read_text(encoding="utf-8")
        for path in Path(continuum_hw_imu.__file__).parents[2].glob("continuum/continuum/inertial/*.py")
    )
    text = re.sub(r"[^a-z~/]+", " ", (SOURCES + library).lower())
    for part in re.split(r"\.\.\.|\bN\b|[,:/%]| \d+ Hz", words):
        wanted = re.sub(r"[^a-z~/]+", " ", part.lower()).strip()
        assert wanted in text, wanted
