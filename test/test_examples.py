"""examples/: every script does what it says, ends with all that it started, and writes into its folder alone."""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from harness.marked import Mark
from harness.waiting import LONG, wait_until

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "examples"
SCRIPTS = sorted(EXAMPLES.glob("*.py"))
NOTEBOOK = EXAMPLES / "find_the_hidden_effect.ipynb"

SAYS = {  # the known answer of each
    "diagnose_your_csv": r"^cause: .*joint_stiffness\.excess\[3\] = 0\.[45]",
    "follow_helix": r"^(\d+) of \1 poses reached",
    "hide_and_find_an_effect": r"^verdict: cause (\w+)(@\d)?$.*^hidden: (\1\.\S+) .*^found:  \3 .*^gain: ",
    "own_arm": r"^released at 60 degrees, swings to -\d",
    "record_and_replay": r"^([1-9]\d*) of \1 poses reached.*as recorded: True$",
    "ros_section_node": r"^90 degrees: .* residual (0e\+00|\de-1\d) m$",
    "simulate_release": r"^held by [\d.]+ N.*^with_friction: complete",
    "solve_ik": r"^position: SOLVED.*^out of reach: UNREACHABLE",
    "tension_step": r"^all friction: tip [\d.]+ mm.*^no dry friction: tip [\d.]+ mm",
}
LARGEST = 60_000
"""Bytes of a picture of the notebook."""


def text_of(script: Path) -> str:
    return script.read_text(encoding="utf-8")


STARTS_NODES = [script for script in SCRIPTS if "import rclpy" in text_of(script)]
COMPUTES = [script for script in SCRIPTS if script not in STARTS_NODES]


def by_name(script: Path) -> str:
    return script.stem


def files_in(folder: Path) -> set[Path]:
    return {path for path in folder.rglob("*") if path.is_file()}


def run(script: Path, folder: Path, *arguments: Path, **environment: str) -> str:
    """Run a script in an empty working folder; what it prints. ROS's logs go there too, unless it says where."""
    here, temporary, mark = folder / "here", folder / "temporary", Mark()
    here.mkdir()
    temporary.mkdir()
    own = {"TMPDIR": str(temporary), "ROS_HOME": str(here / "ros"), "MPLBACKEND": "Agg"}
    others = {name: value for name, value in os.environ.items() if name != "ROS_LOG_DIR"}
    try:
        done = subprocess.run(
            [sys.executable, script, *arguments],
            cwd=here,
            env=others | own | mark.environment | environment,
            capture_output=True,
            text=True,
            timeout=LONG,
        )
        assert done.returncode == 0, done.stderr
        wait_until(lambda: not mark.processes(), lambda: f"end of {mark.processes()}", timeout=10.0)
    finally:
        mark.kill()
    assert files_in(temporary) == set()
    return done.stdout


def check(script: Path, folder: Path, **environment: str) -> None:
    """Run a script with a folder of its own; nothing may be written anywhere else."""
    given, before = folder / "given", files_in(EXAMPLES)
    printed = run(script, folder, given, **environment)
    assert re.search(SAYS[script.stem], printed, re.MULTILINE | re.DOTALL), printed
    assert files_in(given) != set()
    assert files_in(folder / "here") == set()
    assert files_in(EXAMPLES) == before


@pytest.mark.slow
@pytest.mark.parametrize("script", COMPUTES, ids=by_name)
def test_a_script_that_computes(script: Path, tmp_path: Path) -> None:
    check(script, tmp_path)


@pytest.mark.ros
@pytest.mark.parametrize("script", STARTS_NODES, ids=by_name)
def test_a_script_that_starts_nodes(script: Path, tmp_path: Path, domain: int) -> None:
    check(script, tmp_path, ROS_DOMAIN_ID=str(domain))


@pytest.mark.slow
def test_without_an_argument_a_script_writes_below_out(tmp_path: Path) -> None:
    run(EXAMPLES / "solve_ik.py", tmp_path)
    assert files_in(tmp_path) == files_in(tmp_path / "here/out/examples/solve_ik") != set()


def test_every_script_has_a_known_answer() -> None:
    assert SAYS.keys() == {script.stem for script in SCRIPTS}


@pytest.mark.parametrize("script", SCRIPTS, ids=by_name)
def test_a_script_is_short_and_says_how_it_is_run(script: Path) -> None:
    text = text_of(script)
    assert 15 <= len(text.splitlines()) <= 60
    assert f"    python3 examples/{script.name} [FOLDER]\n" in text
    assert text.count(f"out/examples/{script.stem}") == 2  # what its docstring says, and what it does


def saved(notebook: Path) -> list[list[dict[str, Any]]]:
    """Outputs of every code cell."""
    cells = json.loads(text_of(notebook))["cells"]
    return [cell["outputs"] for cell in cells if cell["cell_type"] == "code"]


def shape(output: dict[str, Any]) -> tuple[object, ...]:
    """Kind and words of an output, any figures in them being alike."""
    words = re.sub(r"-?\d+(\.\d+)?(e[+-]\d+)?", "#", "".join(output.get("text", [])))
    return output["output_type"], sorted(output.get("data", {})), words


@pytest.mark.slow
def test_the_notebook_runs_and_says_what_is_saved_in_it(tmp_path: Path) -> None:
    again = Path(shutil.copy(NOTEBOOK, tmp_path))
    done = subprocess.run(
        [sys.executable, "-m", "tools.docs.notebook", again], cwd=ROOT, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert [[*map(shape, cell)] for cell in saved(again)] == [[*map(shape, cell)] for cell in saved(NOTEBOOK)]


def test_the_notebook_has_words_and_small_pictures() -> None:
    outputs = [output for cell in saved(NOTEBOOK) for output in cell]
    pictures = [output["data"]["image/png"] for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) >= 2
    assert max(len(base64.b64decode(picture)) for picture in pictures) < LARGEST
    assert any("verdict: cause" in "".join(output.get("text", [])) for output in outputs)
