"""docs/model-my-arm.md: every command does what the page says, and its table has the keys of the library."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from domain_coordinator import domain_id
from readme.blocks import Block, blocks, words
from readme.scene import Scene
from readme.ways import Run, way_of

from continuum.arm import DYNAMICS, SECTION_PARAMETERS
from continuum.parameter_keys import common_name
from continuum.parameter_spec import ParameterSpec

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "model-my-arm.md").read_text(encoding="utf-8")
BLOCKS = blocks(PAGE)
SHELL = [block for block in BLOCKS if block.language == "sh"]
SHOWN = [block.text for block in BLOCKS if block.language == "text"]

NODES = ("section_1", "robot", "cable_tangler")
ARM = "out/my_arm.yaml"

WAYS = {
    "mkdir -p out": Run(leaves=("out",)),
    "continuum new-arm": Run(says=(f"written: {ARM}",), leaves=(ARM,)),
    "continuum info": Run(says=tuple(map(re.escape, SHOWN))),
    "continuum view": Run(stays=True, serves=True, also="--port 0"),
    "continuum solve": Run(codes=(1,), after_ctrl_c=True, says=("not reached", "section_1_cable_4")),
    "ros2 launch trajectory_generator arm.launch.py": Run(stays=True, nodes=NODES),
    "ros2 run continuum_manipulator viewer": Run(stays=True, nodes=("viewer",), serves=True, also="-p port:=0"),
    "continuum simulate": Run(says=("complete",), leaves=("out/my_release.csv", "out/my_release.png")),
    "ros2 launch continuum_manipulator dynamics.launch.py": Run(
        stays=True, nodes=("dynamics",), hears=(("/joint_states", 10),)
    ),
}
"""How each command is run, by the words with which it begins."""


@pytest.fixture(scope="module")
def checkout(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The checkout, with an `out/` of its own."""
    folder = tmp_path_factory.mktemp("checkout")
    for path in ROOT.iterdir():
        if path.name not in ("out", ".git"):
            (folder / path.name).symlink_to(path)
    return folder


@pytest.fixture
def scene(checkout: Path) -> Iterator[Scene]:
    with domain_id() as number, Scene(checkout, number) as scene:
        yield scene


def test_every_command_has_a_way_and_every_way_a_command() -> None:
    commands = [words(command) for block in SHELL for command in block.commands]
    assert {way_of(command, WAYS) for command in commands} == {*WAYS}


@pytest.mark.ros
@pytest.mark.parametrize("block", SHELL, ids=lambda block: f"line_{block.line}")
def test_commands_do_what_the_page_says(block: Block, scene: Scene) -> None:
    """In their order: the first ones write the file that the others read."""
    for command in block.commands:
        scene.run(command, WAYS[str(way_of(words(command), WAYS))])
    scene.end()


def left_out(spec: ParameterSpec) -> str:
    if spec.is_list:
        return "a quarter turn apart"
    if spec.name == "bend_limit":
        return "π"
    return "required" if spec.default is None else f"{spec.default:g}"


def test_the_table_has_the_keys_of_a_section() -> None:
    rows = re.findall(r"^\| `(\w+)` \|(.*)\|$", PAGE.partition("## The keys")[2], re.MULTILINE)
    cells = {key: [cell.strip() for cell in rest.split("|")] for key, rest in rows}
    assert list(cells) == [*(spec.name for spec in SECTION_PARAMETERS), DYNAMICS]
    for spec in SECTION_PARAMETERS:
        other = f"`{common_name(spec.name)}`" if common_name(spec.name) != spec.name else ""
        assert cells[spec.name] == [other, spec.unit, left_out(spec), spec.description], spec.name
