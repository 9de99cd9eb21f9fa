"""Processes of a launch: their lines, their deaths, and that none outlives the launch."""

import json
import signal
from pathlib import Path

import pytest
from harness.waiting import wait_until

pytestmark = pytest.mark.slow

DEAF = "import signal\nfor s in (signal.SIGINT, signal.SIGTERM): signal.signal(s, signal.SIG_IGN)\n"
STAYS = "\nprint('up', flush=True)\ntime.sleep(600)"
SLEEPS = "import pathlib, os, time\npathlib.Path('{0}.pid').write_text(str(os.getpid()))" + STAYS


def alive(pid: int) -> bool:
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state != "Z"


@pytest.fixture
def launch(ros2, tmp_path: Path):
    """Launch these entities."""

    def start(entities: str, *words: str):
        return ros2.start("launch", write(tmp_path / "test.launch.py", entities), *words)

    return start


def write(file: Path, entities: str) -> Path:
    """A launch file."""
    file.write_text(f"""
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, OpaqueFunction
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([{entities}])
""")
    return file


def test_a_crash_is_reported_and_the_others_go_on(launch) -> None:
    running = launch("""
        ExecuteProcess(cmd=["sh", "-c", "echo hello; exit 3"], name="crash", output="screen"),
        ExecuteProcess(cmd=["sh", "-c", "echo quiet; echo loud >&2"], name="log"),
        ExecuteProcess(cmd=["sleep", "600"])""")
    running.wait_for("[crash-1] hello")
    running.wait_for("[ERROR] [crash-1]: process has died [pid ")
    running.wait_for(", exit code 3, cmd 'sh -c 'echo hello; exit 3''].")
    running.wait_for("[INFO] [log-2]: process has finished cleanly [pid ")
    assert "[log-2] loud" in running.stdout
    assert "quiet" not in running.stdout
    assert running.process.poll() is None
    assert running.stop() == 0
    assert "[WARNING] [launch]: user interrupted with ctrl-c (SIGINT)" in running.stdout
    assert "[ERROR] [sleep-3]: process has died" in running.stdout
    assert running.stderr == ""


def test_a_launch_without_living_processes_ends(launch) -> None:
    assert launch("ExecuteProcess(cmd=['true'])").exit_code() == 0


def test_a_process_that_cannot_start_ends_the_launch(launch) -> None:
    running = launch("ExecuteProcess(cmd=['sleep', '600']), ExecuteProcess(cmd=['/no/such/program'])")
    assert running.exit_code() == 1
    assert "'/no/such/program' cannot be started: No such file" in running.stdout


def test_a_deaf_process_is_killed(launch, program, overlay: Path, tmp_path: Path) -> None:
    program("deaf", DEAF + SLEEPS.format("deaf"))
    deaf = overlay / "deaf"
    running = launch(
        f"ExecuteProcess(cmd=[{str(deaf)!r}], output='screen', sigterm_timeout='0.1', sigkill_timeout='0.1')"
    )
    running.wait_for("[deaf-1] up")
    assert running.stop() == 0
    assert "escalating to 'SIGKILL'" in running.stdout
    assert "exit code -9" in running.stdout
    assert not alive(int((tmp_path / "deaf.pid").read_text()))


def test_helpers_end_with_their_process(launch, program, overlay: Path, tmp_path: Path) -> None:
    program("helper", DEAF + SLEEPS.format("helper"))
    command = ["sh", "-c", f"'{overlay / 'helper'}' & wait"]
    running = launch(f"ExecuteProcess(cmd={command!r}, output='screen', sigterm_timeout='0.1')")
    running.wait_for("[sh-1] up")
    assert running.stop(signal.SIGTERM) == 0
    assert not alive(int((tmp_path / "helper.pid").read_text()))


def test_no_process_outlives_a_killed_launch(launch, program, tmp_path: Path) -> None:
    program("child", SLEEPS.format("child"))
    running = launch("Node(package='demo', executable='child', output='screen')")
    running.wait_for("[child-1] up")
    pid = int((tmp_path / "child.pid").read_text())
    assert alive(pid)
    running.stop(signal.SIGKILL)
    wait_until(lambda: not alive(pid), "end of the child")


def test_parameter_files_last_as_long_as_the_launch(launch, program, tmp_path: Path) -> None:
    code = "import json, pathlib, sys, time\npathlib.Path('args').write_text(json.dumps(sys.argv))" + STAYS
    program("show", code)
    value = "float(context.launch_configurations['v'])"
    show = f"Node(package='demo', executable='show', output='screen', parameters=[{{'p': {value}}}])"
    running = launch(f"DeclareLaunchArgument('v'), OpaqueFunction(function=lambda context: [{show}])", "v:=1.5")
    running.wait_for("[show-1] up")
    words = json.loads((tmp_path / "args").read_text())
    file = Path(words[words.index("--params-file") + 1])
    assert "p: 1.5" in file.read_text()
    running.stop()
    assert not file.exists()


def test_arguments_are_shown_and_mistyped_ones_refused(ros2, tmp_path: Path) -> None:
    one = "DeclareLaunchArgument('number', default_value='1', description='how many', choices=['1', '2'])"
    file = write(tmp_path / "test.launch.py", f"{one}, DeclareLaunchArgument('m')")
    shown = ros2("launch", file, "--show-args").stdout
    assert "'number':\n        how many\n        one of: 1, 2\n        (default: '1')" in shown
    assert "'m':" in shown
    refused = ros2("launch", file, "m:=1", "nunber:=2", code=1).stderr
    assert "no argument 'nunber'; did you mean number?" in refused
    assert "expected format '<name>:=<value>'" in ros2("launch", file, "m=1", code=1).stderr
    assert "missing required argument 'm'" in ros2("launch", file, code=1).stderr


def test_a_file_is_found_in_its_package(ros2, overlay: Path) -> None:
    folder = overlay.parents[1] / "share" / "demo" / "launch"
    write(folder / "hi.launch.py", "ExecuteProcess(cmd=['echo', 'hi from', __file__], output='screen')")
    assert f"hi from {folder}" in ros2("launch", "demo", "hi.launch.py").stdout
    assert "has: hi.launch.py" in ros2("launch", "demo", code=1).stderr
    near = ros2("launch", "demo", "hi.lunch.py", code=1).stderr
    assert "'hi.lunch.py' was not found" in near
    assert "did you mean hi.launch.py?" in near
