"""README.md: every command block does what the page says; a command that nobody said how to run fails.

Blocks are run in a copy of the checkout that shares all but `out/`, and holds the beginning of each recording alone,
which makes a diagnosis of minutes one of seconds. `make` targets are only looked up: each takes minutes, and has tests
of its own.
"""

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from domain_coordinator import domain_id
from readme.blocks import Block, blocks, words
from readme.scene import Scene
from readme.ways import Checked, Run, Way, way_of

from continuum.cli.diagnose import EXIT_CODES
from tools.docs.api.links import problems

ROOT = Path(__file__).resolve().parents[1]
BLOCKS = blocks((ROOT / "README.md").read_text(encoding="utf-8"))

ROWS = 31
"""Of each recording in data/ the blocks see so many rows: 0.25 s."""

THREE = ("section_1", "section_2", "section_3", "robot", "cable_tangler")

WAYS: dict[str, Way] = {
    "make demo": Checked("test/test_whole_demo.py"),
    "make test": Checked("test/test_readme.py"),
    "make bench-demo": Checked("test/test_bench_demo.py"),
    "source install/setup.bash": Run(),
    "mkdir -p out": Run(leaves=("out",)),
    "ros2 launch trajectory_generator arm.launch.py trajectory:=helix.yaml": Run(
        stays=True, nodes=(*THREE, "recorder"), hears=(("/cable_states", 150),), leaves=("out/run/metadata.yaml",)
    ),
    "ros2 topic echo /cable_states": Run(stays=True, says=("section_3_cable_4",)),
    "continuum report": Run(  # Ctrl-C comes long before the end of the helix, and cuts what is on its way then
        after_ctrl_c=True, says=(r"poses reached +[1-9]\d\d",), leaves=("out/report/cables.png",)
    ),
    "ros2 launch trajectory_generator arm.launch.py": Run(stays=True, nodes=THREE),
    "ros2 bag record /cable_states": Run(stays=True, listens="/cable_states", leaves=("rosbag2_*/metadata.yaml",)),
    "ros2 topic pub --once -w 1 /traj_pose": Run(hears=(("/joint_states", 1), ("/cable_states", 1))),
    "continuum info": Run(says=("section_3",)),
    "ros2 run continuum_description create_continuum_robot": Run(leaves=("out/arm.urdf",)),
    "ros2 run continuum_manipulator section": Run(stays=True, nodes=("section",)),
    "continuum view": Run(stays=True, after_ctrl_c=True, serves=True, also="--port 0"),
    "ros2 run continuum_manipulator viewer": Run(
        stays=True, nodes=("viewer",), serves=True, also="--ros-args -p port:=0"
    ),
    "continuum solve": Run(says=("section_1",)),
    "continuum simulate --release 90 --pulled": Run(leaves=("out/release.csv", "out/release.png")),
    "ros2 launch continuum_manipulator dynamics.launch.py": Run(
        stays=True, nodes=("dynamics",), hears=(("/joint_states", 10),)
    ),
    "ros2 topic pub -r 20 /cable_tension_cmd": Run(stays=True, says=("publishing #20:",)),
    "ros2 service call /dynamics/release": Run(says=("success=True",)),
    "ros2 service call /dynamics/reset": Run(says=("success=True",)),
    "continuum diagnose": Run(
        codes=tuple(EXIT_CODES.values()),  # of a part of the run; that of the whole is in docs/prototype.md
        leaves=("out/diagnosis.html", "out/better.yaml"),
    ),
    "continuum identify": Run(says=("Stiffness K",), leaves=("out/identified.yaml",)),
    "ros2 launch continuum_hw_imu bench.launch.py": Run(
        stays=True, nodes=("bench_bridge",), also="emulator_link:={folder}/port emulator_control:={folder}/control"
    ),
    "ros2 topic echo --once /diagnostics": Run(says=("level:",)),
}
"""How each command is run, by the words with which it begins."""

SHELL = [block for block in BLOCKS if block.language == "sh"]


def commands() -> list[str]:
    return [words(command) for block in SHELL for command in block.commands]


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The checkout, with an `out/` of its own."""
    folder = tmp_path_factory.mktemp("checkout")
    for path in ROOT.iterdir():
        if path.name not in ("out", "data", ".git"):
            (folder / path.name).symlink_to(path)
    for table in (ROOT / "data").rglob("*.csv"):
        part = folder / table.relative_to(ROOT)
        part.parent.mkdir(parents=True, exist_ok=True)
        lines = table.read_text(encoding="utf-8").splitlines(keepends=True)
        part.write_text("".join(lines[: 1 + ROWS]), encoding="utf-8")
    return folder


@pytest.fixture
def scene(checkout: Path) -> Iterator[Scene]:
    with domain_id() as number, Scene(checkout, number) as scene:
        yield scene


def test_the_page_has_no_block_of_another_kind() -> None:
    assert {block.language for block in BLOCKS} == {"sh", "python", "text"}


def test_someone_said_how_every_command_is_run() -> None:
    assert [command for command in commands() if way_of(command, WAYS) is None] == []


def test_every_way_is_used() -> None:
    assert {way_of(command, WAYS) for command in commands()} >= WAYS.keys()


@pytest.mark.ros
@pytest.mark.parametrize("block", SHELL, ids=lambda block: f"line_{block.line}")
def test_commands_do_what_the_page_says(block: Block, scene: Scene) -> None:
    for command in block.commands:
        way = WAYS[str(way_of(words(command), WAYS))]
        if isinstance(way, Checked):
            check(words(command), way)
        else:
            scene.run(command, way)
    scene.end()


def check(command: str, way: Checked) -> None:
    """Make knows the target, and the test of it is there."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}
    dry = subprocess.run([*command.split(), "--dry-run"], cwd=ROOT, env=environment, capture_output=True, text=True)
    assert dry.returncode == 0, dry.stderr
    assert (ROOT / way.by).is_file()


@pytest.mark.parametrize("block", [b for b in BLOCKS if b.language == "python"], ids=lambda block: f"line_{block.line}")
def test_python_does_what_the_page_says(block: Block) -> None:
    done = subprocess.run([sys.executable, "-c", block.text], cwd=ROOT, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("SOLVED [[")


@pytest.mark.ros
def test_the_page_of_a_diagnosis_says_how_it_was_made_and_loads_nothing_from_elsewhere(checkout: Path) -> None:
    """Made by the block of `continuum diagnose` above; skipped where that was not run."""
    page = checkout / "out" / "diagnosis.html"
    if not page.exists():
        pytest.skip("no diagnosis was made in this run")
    made = r"Made on \d{4}-\d\d-\d\d by continuum [\d.]+\. Recordings: [\w.]+\. Model: lamecc_prototype.yaml\.</p>"
    assert re.search(made, page.read_text(encoding="utf-8"))
    alone = checkout / "out" / "alone"
    alone.mkdir()
    page.rename(alone / page.name)
    assert problems(alone) == []
