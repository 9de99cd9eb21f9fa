"""Completion as a shell asks for it: subcommands, options, and names of what comes with the library."""

import os
import subprocess
from pathlib import Path

import pytest
from test_cli_parser import COMMANDS, OPTIONS

from continuum.dynamics.effect_lookup import effect_names
from continuum.shipped_files import ARMS, MODELS, shipped_names

pytestmark = pytest.mark.slow


def completions(line: str, folder: Path) -> set[str]:
    """What the command offers behind a line, by the protocol of `register-python-argcomplete`."""
    answer = folder / "answer"
    asked = {
        "_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n", "_ARGCOMPLETE_SHELL": "bash", "COMP_LINE": line,
        "COMP_POINT": str(len(line)), "_ARGCOMPLETE_STDOUT_FILENAME": str(answer),
    }  # fmt: skip
    done = subprocess.run(["continuum"], env={**os.environ, **asked}, cwd=folder, capture_output=True, check=False)
    assert (done.stdout, done.stderr) == (b"", b"")
    return {one.rstrip() for one in answer.read_text(encoding="utf-8").split("\n")} - {""}


def test_all_subcommands_are_listed(tmp_path: Path) -> None:
    for words in {words for words, _ in COMMANDS}:
        offered = completions(" ".join(["continuum", *words, ""]), tmp_path)
        assert {name for at, name in COMMANDS if at == words} == {one for one in offered if not one.startswith("-")}


@pytest.mark.parametrize("words", OPTIONS, ids=" ".join)
def test_all_options_are_listed(words: tuple[str, ...], tmp_path: Path) -> None:
    offered = completions(" ".join(["continuum", *words, "--"]), tmp_path)
    assert offered == {name for name in OPTIONS[words] if name.startswith("--")}


@pytest.mark.parametrize(
    ("line", "names"),
    [
        ("info ", shipped_names(ARMS)),
        ("solve ", shipped_names(ARMS)),
        ("view ", shipped_names(ARMS)),
        ("report run --arm ", shipped_names(ARMS)),
        ("simulate --model ", shipped_names(MODELS)),
        ("diagnose run.csv --model ", shipped_names(MODELS)),
        ("diagnose run.csv --without ", effect_names()),
    ],
)
def test_names_and_own_files_are_listed(line: str, names: list[str], tmp_path: Path) -> None:
    for name in ("mine.yaml", "run.csv", "page.html"):
        (tmp_path / name).touch()
    own = {"view ": {"mine.yaml", "run.csv"}, "diagnose run.csv --without ": set()}.get(line, {"mine.yaml"})
    offered = completions(f"continuum {line}", tmp_path)
    assert {one for one in offered if not one.startswith("-")} == {*names} | own


def test_the_line_of_the_page_switches_it_on(tmp_path: Path) -> None:
    shell = 'eval "$(register-python-argcomplete continuum)"; complete -p continuum'
    done = subprocess.run(["bash", "-c", shell], capture_output=True, text=True, cwd=tmp_path, check=True)
    assert done.stdout.rstrip().endswith(" continuum")
