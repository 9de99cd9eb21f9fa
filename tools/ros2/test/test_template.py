"""Texts with substitutions, and their words."""

import shlex

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2_standin.errors import UserError
from ros2_standin.launch.substitution import truth
from ros2_standin.launch.template import Call, parse_template, split_words


@given(st.text())
def test_every_text_can_be_written_with_backslashes(text: str) -> None:
    escaped = "".join("\\" + character for character in text)
    assert parse_template(escaped) == ((text,) if text else ())


@given(st.text(alphabet="ab$()'\" \\\n", max_size=30))
def test_any_text_is_parsed_or_refused(text: str) -> None:
    try:
        parsed = parse_template(text)
    except UserError:
        return
    assert all(isinstance(part, str | Call) for part in parsed)


def test_nested_and_quoted() -> None:
    text = "a $(equals $(var x) 'b c') $(env \"N M\" $(dirname)/d)"
    assert parse_template(text) == (
        "a ",
        Call("equals", ((Call("var", (("x",),)),), ("b c",))),
        " ",
        Call("env", (("N M",), (Call("dirname", ()), "/d"))),
    )


@pytest.mark.parametrize("text", ["$(var x", "$(eval 'x", "$()", "$($(var x) y)"])
def test_mistakes_are_refused(text: str) -> None:
    with pytest.raises(UserError):
        parse_template(text)


@given(st.text(alphabet="ab '\"\t", max_size=20))
def test_words_are_those_of_a_shell(text: str) -> None:
    try:
        expected = shlex.split(text)
    except ValueError:
        with pytest.raises(UserError):
            split_words(parse_template(text))
        return
    assert [("".join(word)) for word in split_words(parse_template(text))] == expected


def test_a_substitution_stays_one_word() -> None:
    words = split_words(parse_template("-d $(find-pkg-share p)/x.rviz '$(var a) b'"))
    assert words == [("-d",), (Call("find-pkg-share", (("p",),)), "/x.rviz"), (Call("var", (("a",),)), " b")]


@pytest.mark.parametrize(
    ("text", "value"), [("true", True), ("1", True), (" True\n", True), ("false", False), ("0", False)]
)
def test_conditions_are_words_or_figures(text: str, value: bool) -> None:
    assert truth(text) is value
