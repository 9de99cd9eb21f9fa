"""docs/portugues.md: its verdict is the one that its commands print, its exit codes and options are the command's."""

import re
import shlex
import subprocess
from pathlib import Path

import pytest

from continuum.cli import command_parser
from continuum.cli.diagnose import EXIT_CODES

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "portugues.md").read_text(encoding="utf-8")


def first_diagnosis() -> tuple[list[str], str]:
    """The commands of the section on the first diagnosis, and what the page says that they print at first."""
    section = PAGE.partition("## O primeiro diagnóstico")[2].partition("\n## ")[0]
    commands, printed = (re.search(rf"```{kind}\n(.*?)```", section, re.DOTALL) for kind in ("sh", "text"))
    assert commands is not None
    assert printed is not None
    return commands[1].splitlines(), printed[1]


def words(text: str) -> list[str]:
    """Without figures, whose last digits are another machine's."""
    return re.sub(r"[-+]?\d[\d.e]*", "0", text).split()


@pytest.mark.slow
def test_the_first_diagnosis_prints_what_the_page_says(tmp_path: Path) -> None:
    commands, expected = first_diagnosis()
    for command in commands:
        given = [str(ROOT / word) if word.startswith("examples/") else word for word in shlex.split(command)]
        done = subprocess.run(given, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == EXIT_CODES["cause"], done.stderr
    assert words(done.stdout)[: len(words(expected))] == words(expected)


def test_exit_codes_of_a_diagnosis_are_those_of_the_command() -> None:
    rows = re.findall(r"^\| `diagnose` \| (\d) \| [^(|]*\(`(\w+)`\)", PAGE, re.MULTILINE)
    assert {kind: int(code) for code, kind in rows} == EXIT_CODES


def test_the_page_names_the_commands_that_speak_portuguese() -> None:
    sentence = re.search(r"^`--lang pt` vale para (.*?)\.", PAGE, re.MULTILINE | re.DOTALL)
    assert sentence is not None
    (commands,) = (action.choices for action in command_parser()._actions if action.dest == "command")
    assert commands is not None
    able = {name for name, parser in dict(commands).items() if "--lang" in parser._option_string_actions}
    assert {*re.findall(r"`(\w+)`", sentence[1])} == able
