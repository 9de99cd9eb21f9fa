"""A node that is started wrongly says so in one line and ends; one that is stopped ends without a traceback."""

import signal

import pytest
from harness import ARM_FILE, NodeProcess, Probe, ended_in_any_case

pytestmark = pytest.mark.ros

ARM = (ARM_FILE,)

BAD_PARAMETERS = {
    "negative radius": ("section", ARM, {"section": 1, "arm.section_2.a": -0.03}, "arm.section_2.a is -0.03; allowed:"),
    "section beyond the arm": ("section", ARM, {"section": 4}, "section is 4; allowed: 1 to 3"),
    "quality of service of an unknown topic": (
        "robot",
        ARM,
        {"qos_overrides./joint_state.publisher.depth": 5},
        "unknown parameter 'qos_overrides./joint_state.",
    ),
    "unknown quality of service": (
        "robot",
        ARM,
        {"qos_overrides./joint_states.publisher.reliability": "perhaps"},
        "reliability is 'perhaps'; allowed",
    ),
    "section of the wrong type": ("section", ARM, {"section": "first"}, "section is 'first'; allowed: a whole number"),
    "unknown name": ("robot", ARM, {"targets": "position"}, "unknown parameter 'targets'; did you mean target?"),
    "no arm": ("markers", (), {}, "no arm is given; start the node with --ros-args --params-file"),
    "an arm in the place of a model": ("dynamics", (), {"model": "prototype.yaml"}, "prototype.yaml: is an arm file"),
    "no section of an arm": ("dynamics", (), {"model": ARM_FILE}, "allowed: section_1 or section_2 or section_3"),
    "two postures": (
        "dynamics",
        (),
        {"initial_bend": 1.0, "initial_angles": "[0.1, 0.1, 0.1, 0.1, 0.1]"},
        "initial_bend is 1.0; allowed: 0 if initial_angles",
    ),
    "angles of another arm": (
        "dynamics",
        (),
        {"initial_angles": "[0.1, 0.2]"},
        "initial_angles is [0.1, 0.2]; allowed: 5",
    ),
    "unknown storage": ("recorder", (), {"storage": "tape"}, "storage is 'tape'; allowed: one of mcap, sqlite3"),
    "address of another machine": ("viewer", ARM, {"host": "198.51.100.1"}, "198.51.100.1"),
}


def error_lines(node: NodeProcess) -> list[str]:
    with ended_in_any_case(node):
        assert node.exit_code() == 2
        return node.stderr.splitlines()


@pytest.fixture(scope="module")
def badly_started(domain):
    """Nodes of all cases, started side by side."""
    nodes = {
        case: NodeProcess("continuum_manipulator", executable, domain, files=files, parameters=parameters)
        for case, (executable, files, parameters, _) in BAD_PARAMETERS.items()
    }
    with ended_in_any_case(*nodes.values()):
        yield nodes


@pytest.mark.parametrize("case", BAD_PARAMETERS)
def test_bad_parameter_ends_the_node_with_one_line(case, badly_started):
    executable, _, _, expected = BAD_PARAMETERS[case]
    lines = error_lines(badly_started[case])
    assert len(lines) == 1
    assert expected in lines[0]
    assert lines[0].startswith(f"{executable}: error: ")


def test_arm_file_that_is_no_parameter_file(domain, tmp_path):
    file = tmp_path / "arm.yaml"
    file.write_text("/**:\n  ros__parameters:\n    arm: {sections: [a, 1.5]}\n")
    (line,) = error_lines(NodeProcess("continuum_manipulator", "robot", domain, files=(file,)))
    assert str(file) in line
    assert ".c:" not in line


def test_simulated_time_is_on_or_off(domain):
    node = NodeProcess("continuum_manipulator", "robot", domain, files=ARM, parameters={"use_sim_time": "perhaps"})
    *said_by_ros, line = error_lines(node)
    assert all(line.startswith("[ERROR]") for line in said_by_ros)
    assert line == "robot: error: use_sim_time is 'perhaps'; allowed: true or false"


def test_unknown_argument(domain):
    (line,) = error_lines(NodeProcess("continuum_manipulator", "robot", domain, arguments=("--verbose",)))
    assert "unknown argument '--verbose'" in line


@pytest.fixture(scope="module")
def probe(domain):
    with Probe(domain) as probe:
        yield probe


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("delay", ["at once", "when it runs"])
def test_signal_ends_a_node_cleanly_from_its_first_moment(domain, probe, number, delay):
    """Also where it comes twice."""
    name = f"section_{delay}_{number.name}".replace(" ", "_")
    node = NodeProcess("continuum_manipulator", "section", domain, name=name, files=ARM, parameters={"section": 1})
    with ended_in_any_case(node):
        node.wait_for_handler()
        if delay == "when it runs":
            probe.wait_for_nodes(name)
        node.send(number)
        node.send(number)
        assert node.exit_code() == 0
        assert all(line.startswith("[INFO]") for line in node.stderr.splitlines())  # no more than that it began
