"""Grammar, help, and mistakes of the command itself."""

import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2_standin.cli import build_parser, find_verb, split_ros_args
from ros2_standin.commands import COMMANDS, Family
from ros2_standin.topic_hz import ArrivalRate

VERBS = [
    (name, *verb)
    for name, command in COMMANDS.items()
    for verb in ([(verb,) for verb in command.verbs] if isinstance(command, Family) else [()])
]


@pytest.mark.parametrize("words", [(), *VERBS], ids=" ".join)
def test_help_says_that_it_is_a_stand_in(words: tuple[str, ...]) -> None:
    text = " ".join(_help_of(words).split())
    assert "not the stock ros2" in text.replace("- ", "-")


def _help_of(words: tuple[str, ...]) -> str:
    parser = build_parser(words)
    for word in words:
        choices = next(action.choices for action in parser._actions if action.nargs == "A...")
        parser = choices[word]
    return parser.format_help()


def test_help_does_not_load_ros(ros2) -> None:
    code = (
        "import sys\nfrom ros2_standin.cli import main\n"
        "try: main(['--help'])\nfinally: sys.exit('rclpy' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], env=ros2.environment, capture_output=True, check=False)
    assert done.returncode == 0


@given(st.lists(st.sampled_from(["a", "--ros-args", "--", "-r", "x:=y"])))
def test_ros_arguments_are_parted_without_loss(words: list[str]) -> None:
    own, ros_args = split_ros_args(words)
    assert sorted(own + ros_args) == sorted(words)
    assert "--ros-args" not in own
    assert not ros_args or ros_args[0] == "--ros-args"


def test_every_verb_is_found() -> None:
    assert all(find_verb(words) is not None for words in VERBS)
    assert find_verb(["nix"]) is None
    assert find_verb([]) is None


def test_mistakes(ros2) -> None:
    assert "invalid choice" in ros2("nix", code=2).stderr
    assert "Package 'nix' not found" in ros2("run", "nix", "nix", code=1).stderr
    assert "AMENT" not in ros2("pkg", "prefix", "rclpy").stderr


def test_run_becomes_the_program(ros2, program, tmp_path: Path) -> None:
    program("show", "import os, sys\nprint(os.getpid(), *sys.argv[1:])\nsys.exit(7)")
    running = ros2("run", "demo", "show", "--ros-args", "-p", "a:=1", "--help", code=7)
    assert running.stdout.split() == [str(running.process.pid), "--ros-args", "-p", "a:=1", "--help"]
    assert "has no 'nix' (it has: show)" in ros2("run", "demo", "nix", code=1).stderr
    assert ros2("pkg", "executables", "demo").stdout == "demo show\n"


@given(st.lists(st.integers(1, 1000), min_size=1, max_size=50), st.integers(1, 20))
def test_arrival_rate(intervals: list[int], window: int) -> None:
    rate = ArrivalRate(window)
    assert rate.text() is None
    instant = 0.0
    rate.arrive(instant)
    for interval in intervals:
        instant += interval
        rate.arrive(instant)
    counted = intervals[-window:]
    assert rate.text().startswith(f"average rate: {len(counted) / sum(counted):.3f}\n")
    assert f"min: {min(counted):.3f}s max: {max(counted):.3f}s" in rate.text()
    assert rate.text().endswith(f"window: {len(counted) + 1}")
