"""Launch files: what is covered is stock's, what they ask for, and that their errors are one line."""

import ast
import dataclasses
import sys
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml

from ros2_standin.errors import UserError
from ros2_standin.launch import python_api
from ros2_standin.launch.launch_file import LaunchFile, ParameterFiles

ROOT = Path(__file__).parents[3]
SHIPPED = sorted([*ROOT.glob("*/launch/*.launch.py"), *ROOT.glob("*/*/launching.py")])

STOCK = {
    "launch.LaunchContext": ("launch_configurations", "is_shutdown"),
    "launch.LaunchDescription": ("initial_entities",),
    "launch.actions.DeclareLaunchArgument": ("name", "default_value", "description", "choices"),
    "launch.actions.ExecuteProcess": (
        "cmd", "prefix", "name", "cwd", "env", "additional_env", "shell", "sigterm_timeout", "sigkill_timeout",
        "emulate_tty", "output", "output_format", "log_cmd", "on_exit", "respawn", "respawn_delay",
        "respawn_max_retries", "condition",
    ),
    "launch.actions.OpaqueFunction": ("function", "args", "kwargs"),
    "launch.actions.RegisterEventHandler": ("event_handler",),
    "launch.event_handlers.OnProcessExit": ("target_action", "on_exit"),
    "launch.events.process.ProcessExited": ("action", "name", "cmd", "cwd", "env", "pid", "returncode", "process_name"),
    "launch_ros.actions.Node": (
        "executable", "package", "name", "namespace", "exec_name", "parameters", "remappings", "ros_arguments",
        "arguments", "output", "respawn", "respawn_delay", "on_exit", "emulate_tty", "sigterm_timeout",
        "sigkill_timeout", "condition", "cwd", "env", "additional_env", "prefix",
    ),
    "launch_ros.parameter_descriptions.ParameterValue": ("value", "value_type"),
}  # fmt: skip
"""Arguments, and of contexts and events the properties, that the documentation of Jazzy's launch (3.4) and launch_ros
(0.26) gives these classes."""


@pytest.fixture
def evaluate(tmp_path: Path, program, ros2, monkeypatch: pytest.MonkeyPatch):
    """Evaluate a launch file whose function returns ``entities``; the package ``demo`` has the executable ``talk``."""
    program("talk", "")
    monkeypatch.setenv("AMENT_PREFIX_PATH", ros2.environment["AMENT_PREFIX_PATH"])
    with ParameterFiles() as files:

        def run(entities: str, before: str = "", only_arguments: bool = False, **given: str) -> LaunchFile:
            imports = "".join(
                f"from {module} import {', '.join(one.__name__ for one in classes)}\n"
                for module, classes in python_api.MODULES.items()
                if classes
            )
            file = tmp_path / "test.launch.py"
            file.write_text(
                f"{imports}{before}\ndef generate_launch_description():\n    return LaunchDescription([{entities}])\n"
            )
            launch = LaunchFile(files, given, only_arguments)
            launch.read(file)
            return launch

        yield run


def test_nothing_is_covered_that_stock_does_not_have() -> None:
    covered = {f"{module}.{one.__name__}": one for module, classes in python_api.MODULES.items() for one in classes}
    assert covered.keys() == STOCK.keys()
    for name, one in covered.items():
        assert {field.name for field in dataclasses.fields(one)} <= set(STOCK[name])


@pytest.mark.parametrize("file", SHIPPED, ids=lambda file: file.name)
def test_launch_files_of_the_workspace_import_what_stock_has(file: Path) -> None:
    imported = {
        f"{node.module}.{alias.name}"
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and str(node.module).split(".")[0] in ("launch", "launch_ros")
        for alias in node.names
    }
    assert imported
    assert imported <= STOCK.keys()


def test_a_function_makes_a_node_of_arguments(evaluate, tmp_path: Path) -> None:
    given = tmp_path / "given.yaml"
    given.write_text("{}")
    found = evaluate(
        "DeclareLaunchArgument('gain', default_value='1.0'), OpaqueFunction(function=nodes)",
        f"""
def nodes(context):
    gain = float(context.launch_configurations["gain"])
    text = ParameterValue("$(a) 1", value_type=str)
    return [
        Node(package="demo", executable="talk", name="t", namespace="lab", exec_name="label", output="screen",
             parameters=[{str(given)!r}, {{"gain": gain, "block": {{"text": text, "nodes": ["a", "b"]}}}}],
             remappings=[("in", "out")], arguments=["-d", "x y"])
    ]
""",
        gain="2.5",
    )
    (node,) = found.processes
    words = node.command[node.command.index("--ros-args") + 1 :]
    assert node.command[1:3] == ["-d", "x y"]
    assert words[:6] == ["-r", "__node:=t", "-r", "__ns:=/lab", "--params-file", str(given)]
    assert words[-2:] == ["-r", "in:=out"]
    assert yaml.safe_load(Path(words[7]).read_text()) == {
        "/lab/t": {"ros__parameters": {"gain": 2.5, "block": {"text": "$(a) 1", "nodes": ["a", "b"]}}}
    }
    assert (node.name, node.stdout_to_screen) == ("label", True)


def test_arguments_are_found_without_calling_functions(evaluate) -> None:
    found = evaluate("DeclareLaunchArgument('a'), OpaqueFunction(function=None)", only_arguments=True)
    assert list(found.arguments) == ["a"]


def test_the_stock_names_are_free_again_after_loading(evaluate) -> None:
    before = {name: sys.modules.get(name) for name in python_api.MODULES}
    evaluate("")
    assert {name: sys.modules.get(name) for name in python_api.MODULES} == before


@pytest.mark.parametrize(
    ("entities", "problem"),
    [
        ("1", "test.launch.py: int is not covered here"),
        ("Node(package='demo', executable='talk', exec='x')", "Caught exception in launch .*exec"),
        ("Node(package='demo', executable='talk', parameters=['/nix.yaml'])", "'/nix.yaml' does not exist"),
        ("Node(package='demo', executable='talk', parameters=[{'a': '1'}])", "a is the text '1', .*ParameterValue"),
        ("OpaqueFunction(function=lambda context: 1 / 0)", "Caught exception in launch .*division by zero"),
        ("DeclareLaunchArgument('a', choices=['b'], default_value='c')", "'a' is 'c'; allowed: b"),
        ("DeclareLaunchArgument('a', description='how many')", "missing required argument 'a' .*how many.*given: none"),
        ("ExecuteProcess(cmd=['true'], output='loud')", "output='loud'; allowed: screen"),
        ("Node(package='demo', executable='nix')", "No executable found.*talk"),
        ("Node(package='nix', executable='nix')", "Package 'nix' not found"),
        ("LaunchDescription", "type is not covered"),
        (")", "Caught exception in launch"),
    ],
)
def test_mistakes_come_in_one_line(evaluate, entities: str, problem: str) -> None:
    with pytest.raises(UserError, match=problem) as error:
        evaluate(entities)
    assert "\n" not in str(error.value)


def test_an_exit_handler_that_raises_ends_the_launch_and_sees_who_ended(ros2, tmp_path: Path) -> None:
    file = tmp_path / "test.launch.py"
    file.write_text("""
from launch import LaunchDescription
from launch.actions import ExecuteProcess, RegisterEventHandler
from launch.event_handlers import OnProcessExit

def on_exit(event, context):
    if not context.is_shutdown:
        raise RuntimeError(f"{event.process_name} gave {event.returncode}")

def generate_launch_description():
    return LaunchDescription([
        RegisterEventHandler(OnProcessExit(on_exit=on_exit)),
        ExecuteProcess(cmd=["sleep", "600"]),
        ExecuteProcess(cmd=["false"], name="short"),
    ])
""")
    launch = ros2("launch", file, code=1)
    errors = [line for line in launch.stdout.splitlines() if line.startswith("[ERROR] [launch]")]
    assert errors == ["[ERROR] [launch]: Caught exception in launch (see debug for traceback): short-2 gave 1"]


def test_an_exit_handler_of_an_action_sees_no_other_process(ros2, tmp_path: Path) -> None:
    """As of a file that another one includes, whose processes may end."""
    file = tmp_path / "test.launch.py"
    file.write_text("""
from launch import LaunchDescription
from launch.actions import ExecuteProcess, RegisterEventHandler
from launch.event_handlers import OnProcessExit

def on_exit(event, context):
    raise RuntimeError(f"{event.process_name} ended")

def generate_launch_description():
    required = ExecuteProcess(cmd=["sleep", "0.5"], name="required")
    return LaunchDescription([
        RegisterEventHandler(OnProcessExit(target_action=required, on_exit=on_exit)),
        ExecuteProcess(cmd=["false"], name="foreign"),
        required,
    ])
""")
    launch = ros2("launch", file, code=1)
    assert "required-2 ended" in launch.stdout
    assert "foreign-1 ended" not in launch.stdout


def test_launch_files_of_the_workspace_refuse_unknown_arguments_where_the_stock_launch_takes_them() -> None:
    """Of the command line alone: who includes the file has arguments of its own."""
    with python_api.importable():
        from continuum_description.launching import refuse_unknown
    file = Path("/opt/ws/share/trajectory_generator/launch/arm.launch.py")
    words = ["/opt/ros/bin/ros2", "launch", "trajectory_generator", "arm.launch.py", "mode:=cables", "trajektory:=a"]
    known = ["arm", "mode", "trajectory"]
    for named in (words, [*words[:2], str(file), *words[4:]]):
        with pytest.raises(
            RuntimeError, match=r"arm\.launch\.py has no argument 'trajektory'; did you mean trajectory\?"
        ):
            refuse_unknown(file, known, named)
    with pytest.raises(RuntimeError, match="known: arm, mode, trajectory"):
        refuse_unknown(file, known, [*words[:-1], "x:=1"])
    refuse_unknown(file, known, words[:-1])
    refuse_unknown(file.with_name("part.launch.py"), known, words)
    refuse_unknown(file, known, [*words[:2], "my_bench", *words[3:]])  # a file of the same name in another package
    refuse_unknown(file, known, [*words[:2], "/home/me/arm.launch.py", *words[4:]])


@pytest.mark.parametrize(
    ("process", "code", "ends"),
    [("rviz2-3", -6, False), ("joint_state_publisher_gui-2", 1, False), ("trajectory_publisher-1", 0, False),
     ("trajectory_publisher-1", 1, True), ("robot-1", 0, True)],
)  # fmt: skip
def test_a_launch_outlives_its_windows_however_they_end(process: str, code: int, ends: bool) -> None:
    with python_api.importable():
        from continuum_description.launching import miss
    event, context = SimpleNamespace(process_name=process, returncode=code), SimpleNamespace(is_shutdown=False)
    with pytest.raises(RuntimeError, match="requires it") if ends else nullcontext():
        miss(event, context)
