"""Reading of command blocks, and what is said of how they are run."""

import pytest
from readme.blocks import blocks, outside_of_blocks, without_comment, words
from readme.ways import Run, way_of

PAGE = """\
text
```sh
# a comment
one a    # what it does
two \\
  '{b: 1,
    c}'

```
```python
x = "```"
```
"""


def test_blocks_know_their_language_and_line() -> None:
    assert [(b.language, b.line) for b in blocks(PAGE)] == [("sh", 2), ("python", 10)]
    assert blocks(PAGE)[1].text == 'x = "```"\n'
    assert outside_of_blocks(PAGE) == "text"


def test_commands_are_joined_and_comments_left_out() -> None:
    one, two = blocks(PAGE)[0].commands
    assert (one, words(one), without_comment(one)) == ("one a    # what it does", "one a", "one a")
    assert words(two) == "two {b: 1,\n    c}"


@pytest.mark.parametrize("page", ["```sh\none", "a\n```\n"])
def test_a_block_that_does_not_end_is_refused(page: str) -> None:
    with pytest.raises(ValueError, match="does not end"):
        blocks(page)


@pytest.mark.parametrize("text", ["one \\", "one 'two", 'one "two'])
def test_a_command_that_does_not_end_is_refused(text: str) -> None:
    (block,) = blocks(f"```sh\n{text}\n```")
    with pytest.raises(ValueError, match="does not end"):
        _ = block.commands


def test_the_longest_beginning_counts() -> None:
    ways = {"make": Run(), "make demo": Run(), "make de": Run()}
    assert way_of("make demo VIEW=1", ways) == "make demo"
    assert way_of("make demos", ways) == "make"
    assert way_of("cmake", ways) is None
