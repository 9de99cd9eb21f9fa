"""The parser of `continuum`: every subcommand has help, and a misspelt name suggests the right one in one line."""

import argparse
import importlib.metadata
import io
import re
from collections.abc import Iterator
from contextlib import redirect_stderr

import pytest
from command_line import Captured, code, refused
from edits import misspelt
from hypothesis import assume, given
from hypothesis import strategies as st

from continuum.cli import command_parser


def subcommands(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    """Those right under a parser."""
    nested = [action for action in parser._actions if action.nargs == argparse.PARSER]
    return dict(nested[0].choices or {}) if nested else {}


def parsers(parser: argparse.ArgumentParser, *words: str) -> Iterator[tuple[tuple[str, ...], argparse.ArgumentParser]]:
    """The parser and those below it, with the words that lead to each."""
    yield words, parser
    for name, below in subcommands(parser).items():
        yield from parsers(below, *words, name)


PARSER = command_parser()
PARSERS = dict(parsers(PARSER))
OPTIONS = {words: sorted(parser._option_string_actions) for words, parser in PARSERS.items()}
LONG = [(words, name) for words, names in OPTIONS.items() for name in names if name.startswith("--")]
COMMANDS = [(words, name) for words, parser in PARSERS.items() for name in subcommands(parser)]
CHOICES = [
    (words, action.option_strings[0], str(choice))
    for words, parser in PARSERS.items()
    for action in parser._actions
    for choice in action.choices or ()
    if action.option_strings and len(str(choice)) > 2  # to shorter ones nothing is near: all are listed
]


def error_of(*words: str) -> str:
    """The line by which the parser refuses the words."""
    printed = io.StringIO()
    with redirect_stderr(printed), pytest.raises(SystemExit) as end:
        PARSER.parse_args(words)
    assert end.value.code == 2
    assert printed.getvalue().startswith("continuum: ")
    assert printed.getvalue().count("\n") == 1
    return printed.getvalue()


def suggested(line: str) -> list[str]:
    """Names that a line suggests."""
    found = re.search(r"; did you mean (.*)\?\n$", line)
    return found[1].split(" or ") if found else []


@pytest.mark.parametrize("words", PARSERS, ids=" ".join)
def test_every_subcommand_has_help_in_80_columns(words: tuple[str, ...], capsys: Captured) -> None:
    assert code(*words, "--help") == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith(" ".join(["usage: continuum", *words]))
    assert max(map(len, lines)) <= 80


def test_the_version_is_that_of_the_package(capsys: Captured) -> None:
    assert code("--version") == 0
    assert capsys.readouterr().out == f"continuum {importlib.metadata.version('continuum')}\n"


@given(st.data())
def test_a_wrong_option_suggests_the_right_one(data: st.DataObject) -> None:
    words, name = data.draw(st.sampled_from(LONG))
    wrong = data.draw(misspelt(name, first=2))
    assume(not any(known.startswith(wrong) for known in OPTIONS[words]))
    assume(re.match("--[a-z]", wrong))
    assert name in suggested(error_of(*words, wrong))
    assert name in suggested(error_of(*words, f"{wrong}=1"))


def test_an_option_with_one_dash_suggests_the_one_with_two() -> None:
    for words, name in LONG:
        assert name in suggested(error_of(*words, name[1:]))


@given(st.data())
def test_a_wrong_subcommand_suggests_the_right_one(data: st.DataObject) -> None:
    words, name = data.draw(st.sampled_from(COMMANDS))
    wrong = data.draw(misspelt(name))
    assume(wrong not in subcommands(PARSERS[words]) and not wrong.startswith("-"))
    assert name in suggested(error_of(*words, wrong))


@given(st.data())
def test_a_wrong_choice_suggests_the_right_one(data: st.DataObject) -> None:
    words, option, choice = data.draw(st.sampled_from(CHOICES))
    wrong = data.draw(misspelt(choice))
    assume((words, option, wrong) not in CHOICES and not wrong.startswith("-"))
    assert choice in suggested(error_of(*words, option, wrong))


def test_what_is_like_nothing_points_to_the_help(capsys: Captured) -> None:
    for words, at in ((("--qqqq",), ""), (("info", "--qqqq"), " info"), (("model", "new", "--qqqq"), " model new")):
        assert refused(capsys, *words).endswith(f"; see continuum{at} --help\n")
    assert "info, solve" in refused(capsys, "qqqqqqqq")


def test_what_is_left_over_is_refused_by_the_command_that_it_was_given_to(capsys: Captured) -> None:
    assert "unexpected argument: more; see continuum info --help" in refused(capsys, "info", "arm.yaml", "more")
    assert "continuum model from-urdf --help" in refused(capsys, "model", "from-urdf", "a", "b", "--out", "c")


def test_negative_numbers_and_words_behind_two_dashes_are_no_options() -> None:
    options = PARSER.parse_args(["solve", "arm.yaml", "-0.1", "-2", "0.3"])
    assert (options.x, options.y, options.z) == (-0.1, -2.0, 0.3)
    assert PARSER.parse_args(["diagnose", "--", "--run.csv"]).data == ["--run.csv"]
