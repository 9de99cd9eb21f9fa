"""Definitions as text: every field of a message is in it, nested ones too."""

import pytest

from ros2_standin.errors import UserError
from ros2_standin.interface import definition, expanded, interfaces
from ros2_standin.interface_types import message_class

MESSAGES = [name for name in interfaces("sensor_msgs") if "/msg/" in name]


def fields_of(name: str) -> list[str]:
    """Field names in depth-first order, from the generated class instead of the text."""
    found = []
    for field, kind in message_class(name).get_fields_and_field_types().items():
        found.append(field)
        base = kind.removeprefix("sequence<").split("[")[0].split(",")[0].rstrip(">")
        if "/" in base:
            found += fields_of(base)
    return found


@pytest.mark.parametrize("name", MESSAGES)
def test_expanded_definition_has_the_fields_of_the_generated_class(name: str) -> None:
    lines = [line.split("#")[0].split() for line in expanded(name, comments=False)]
    shown = [words[1] for words in lines if len(words) >= 2 and "=" not in " ".join(words)]
    assert shown == fields_of(name)


def test_comments_stay_unless_unwanted() -> None:
    name = "sensor_msgs/msg/JointState"
    assert "\n".join(expanded(name)).startswith(definition(name).splitlines()[0])
    assert not any("#" in line for line in expanded(name, comments=False))


@pytest.mark.parametrize("name", ["nix", "a/b/c/d", "sensor_msgs/msg/Nix", "sensor_msgs/nix/JointState", "../x/msg/A"])
def test_unknown_interface_is_refused(name: str) -> None:
    with pytest.raises(UserError):
        definition(name)
