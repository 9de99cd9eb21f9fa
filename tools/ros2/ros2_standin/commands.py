"""The table of commands and verbs; their modules are imported only when they are run."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class Verb:
    """One verb and its module.

    Attributes:
        summary: one line of help.
        module: module below ``ros2_standin`` that contains the two functions.
        name: ``<name>_arguments(parser)`` and ``<name>_verb(args) -> int | None`` are the two functions.
        passes_arguments: whether everything after the positional arguments belongs to the started program, including
            ``--ros-args``.
    """

    summary: str
    module: str
    name: str
    passes_arguments: bool = False


@dataclass(frozen=True)
class Family:
    """A command that has verbs."""

    summary: str
    verbs: MappingProxyType[str, Verb]


def _family(summary: str, **verbs: Verb) -> Family:
    return Family(summary, MappingProxyType(verbs))


COMMANDS: MappingProxyType[str, Verb | Family] = MappingProxyType(
    {
        "run": Verb("Run a package specific executable", "run", "run", passes_arguments=True),
        "launch": Verb("Run a launch file", "launch.command", "launch", passes_arguments=True),
        "topic": _family(
            "Various topic related sub-commands",
            bw=Verb("Display bandwidth used by topic", "topic_bw", "bw"),
            echo=Verb("Output messages from a topic", "topic_echo", "echo"),
            find=Verb("Output a list of available topics of a given type", "topic_graph", "find"),
            hz=Verb("Print the average receiving rate to screen", "topic_hz", "hz"),
            info=Verb("Print information about a topic", "topic_graph", "info"),
            list=Verb("Output a list of available topics", "topic_graph", "list"),
            pub=Verb("Publish a message to a topic", "topic_pub", "pub"),
            type=Verb("Print a topic's type", "topic_graph", "type"),
        ),
        "node": _family(
            "Various node related sub-commands",
            info=Verb("Output information about a node", "node", "info"),
            list=Verb("Output a list of available nodes", "node", "list"),
        ),
        "param": _family(
            "Various param related sub-commands",
            describe=Verb("Show descriptive information about declared parameters", "param", "describe"),
            dump=Verb("Show all of the parameters of a node in a YAML file format", "param", "dump"),
            get=Verb("Get parameter", "param", "get"),
            list=Verb("Output a list of available parameters", "param", "list"),
            set=Verb("Set parameter", "param", "set"),
        ),
        "service": _family(
            "Various service related sub-commands",
            call=Verb("Call a service", "service", "call"),
            find=Verb("Output a list of available services of a given type", "service", "find"),
            list=Verb("Output a list of available services", "service", "list"),
            type=Verb("Output a service's type", "service", "type"),
        ),
        "lifecycle": _family(
            "Various lifecycle related sub-commands",
            get=Verb("Get lifecycle state for one or more nodes", "lifecycle", "get"),
            list=Verb("Output a list of available transitions", "lifecycle", "list"),
            nodes=Verb("Output a list of nodes with lifecycle", "lifecycle", "nodes"),
            set=Verb("Trigger lifecycle state transition", "lifecycle", "set"),
        ),
        "interface": _family(
            "Show information about ROS interfaces",
            list=Verb("List all interface types available", "interface", "list"),
            package=Verb("Output a list of available interface types within one package", "interface", "package"),
            show=Verb("Output the interface definition", "interface", "show"),
        ),
        "bag": _family(
            "Various rosbag related sub-commands",
            info=Verb("Print information about a bag to the screen", "bag_info", "info"),
            play=Verb("Play back ROS data from a bag", "bag_play", "play"),
            record=Verb("Record ROS data to a bag", "bag_record", "record"),
        ),
        "pkg": _family(
            "Various package related sub-commands",
            executables=Verb("Output a list of package specific executables", "pkg", "executables"),
            list=Verb("Output a list of available packages", "pkg", "list"),
            prefix=Verb("Output the prefix path of a package", "pkg", "prefix"),
        ),
    }
)
