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
    """Launch these tags."""

    def start(tags: str, *words: str):
        file = tmp_path / "test.launch.xml"
        file.write_text(f"<launch>{tags}</launch>")
        return ros2.start("launch", file, *words)

    return start


def test_a_crash_is_reported_and_the_others_go_on(launch) -> None:
    running = launch("""
        <executable cmd="sh -c 'echo hello; exit 3'" name="crash" output="screen"/>
        <executable cmd="sh -c 'echo quiet; echo loud >&amp;2'" name="log"/>
        <executable cmd="sleep 600"/>""")
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
    assert launch('<executable cmd="true"/><log message="m"/>').exit_code() == 0


def test_a_process_that_cannot_start_ends_the_launch(launch) -> None:
    running = launch('<executable cmd="sleep 600"/><executable cmd="/no/such/program"/>')
    assert running.exit_code() == 1
    assert "'/no/such/program' cannot be started: No such file" in running.stdout


def test_a_required_process_ends_the_launch(launch) -> None:
    running = launch('<executable cmd="sleep 600"/><executable cmd="true" on_exit="shutdown"/>')
    assert running.exit_code() == 0
    assert "was required" in running.stdout


def test_a_deaf_process_is_killed(launch, program, tmp_path: Path) -> None:
    program("deaf", DEAF + SLEEPS.format("deaf"))
    running = launch('<node pkg="demo" exec="deaf" output="screen" sigterm_timeout="0.1" sigkill_timeout="0.1"/>')
    running.wait_for("[deaf-1] up")
    assert running.stop() == 0
    assert "escalating to 'SIGKILL'" in running.stdout
    assert "exit code -9" in running.stdout
    assert not alive(int((tmp_path / "deaf.pid").read_text()))


def test_helpers_end_with_their_process(launch, program, tmp_path: Path) -> None:
    program("helper", DEAF + SLEEPS.format("helper"))
    command = "sh -c '&quot;$(exec-in-pkg helper demo)&quot; &amp; wait'"
    running = launch(f'<executable cmd="{command}" output="screen" sigterm_timeout="0.1"/>')
    running.wait_for("[sh-1] up")
    assert running.stop(signal.SIGTERM) == 0
    assert not alive(int((tmp_path / "helper.pid").read_text()))


def test_no_process_outlives_a_killed_launch(launch, program, tmp_path: Path) -> None:
    program("child", SLEEPS.format("child"))
    running = launch('<node pkg="demo" exec="child" output="screen"/>')
    running.wait_for("[child-1] up")
    pid = int((tmp_path / "child.pid").read_text())
    assert alive(pid)
    running.stop(signal.SIGKILL)
    wait_until(lambda: not alive(pid), "end of the child")


def test_respawn(launch) -> None:
    running = launch('<executable cmd="false" respawn="true" respawn_max_retries="2"/>')
    assert running.exit_code() == 0
    assert running.stdout.count("process has died") == 3


def test_parameter_files_last_as_long_as_the_launch(launch, program, tmp_path: Path) -> None:
    code = "import json, pathlib, sys, time\npathlib.Path('args').write_text(json.dumps(sys.argv))" + STAYS
    program("show", code)
    running = launch(
        '<arg name="v"/><node pkg="demo" exec="show" output="screen"><param name="p" value="$(var v)"/></node>',
        "v:=1.5",
    )
    running.wait_for("[show-1] up")
    words = json.loads((tmp_path / "args").read_text())
    file = Path(words[words.index("--params-file") + 1])
    assert "p: 1.5" in file.read_text()
    running.stop()
    assert not file.exists()


def test_arguments_are_shown_and_mistyped_ones_reported(ros2, tmp_path: Path) -> None:
    file = tmp_path / "test.launch.xml"
    file.write_text('<launch><arg name="n" default="1" description="how many"/><arg name="m"/></launch>')
    shown = ros2("launch", file, "--show-args").stdout
    assert "'n':\n        how many\n        (default: '1')" in shown
    assert "'m':" in shown
    assert "no argument 'o'" in ros2("launch", file, "m:=1", "o:=2").stdout
    assert "expected format '<name>:=<value>'" in ros2("launch", file, "m=1", code=1).stderr
    assert "missing required argument 'm'" in ros2("launch", file, code=1).stderr


def test_a_file_is_found_in_its_package(ros2, overlay: Path) -> None:
    folder = overlay.parents[1] / "share" / "demo" / "launch"
    (folder / "hi.launch.xml").write_text('<launch><log message="hi from $(dirname)"/></launch>')
    assert f"hi from {folder}" in ros2("launch", "demo", "hi.launch.xml").stdout
    assert "has: hi.launch.xml" in ros2("launch", "demo", code=1).stderr
    assert "'nix.launch.xml' was not found" in ros2("launch", "demo", "nix.launch.xml", code=1).stderr
