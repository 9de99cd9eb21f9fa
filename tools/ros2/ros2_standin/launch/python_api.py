"""What launch files import, as far as it is covered: a part of the stock ``launch`` and ``launch_ros``.

Names and keywords are those of ROS 2 Jazzy, and no others are taken. These classes only hold what a file says;
`ros2_standin.launch.launch_file` reads them.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path
from types import MappingProxyType, ModuleType


@dataclass
class LaunchContext:
    """State of the launch, as functions of a launch file see it."""

    launch_configurations: dict[str, str] = field(default_factory=dict)
    is_shutdown: bool = False


@dataclass(frozen=True)
class ProcessExited:
    """A process has ended."""

    process_name: str
    returncode: int


@dataclass
class LaunchDescription:
    """What a launch file asks for, in its order."""

    initial_entities: Iterable[object] = ()


@dataclass
class DeclareLaunchArgument:
    """An argument of the file."""

    name: str
    _: KW_ONLY
    default_value: str | None = None
    description: str | None = None
    choices: Iterable[str] | None = None


@dataclass(kw_only=True)
class OpaqueFunction:
    """A function that is called with the context and gives further entities."""

    function: Callable[[LaunchContext], Sequence[object] | None]


@dataclass(kw_only=True)
class OnProcessExit:
    """A function that is called whenever the process of an action has ended, or without one any process."""

    target_action: object | None = None
    on_exit: Callable[[ProcessExited, LaunchContext], None]


@dataclass
class RegisterEventHandler:
    """Takes an event handler up."""

    event_handler: OnProcessExit


@dataclass(kw_only=True)
class ExecuteProcess:
    """A program; times are texts in s."""

    cmd: Sequence[str]
    name: str | None = None
    output: str = "log"
    sigterm_timeout: str = "5"
    sigkill_timeout: str = "5"


@dataclass
class ParameterValue:
    """A parameter whose type is demanded; of plain text the stock launch guesses it."""

    value: object
    _: KW_ONLY
    value_type: type = str


@dataclass(kw_only=True)
class Node:
    """A node; its parameters are names of files, or mappings of values, which may hold mappings."""

    package: str
    executable: str
    name: str | None = None
    namespace: str | None = None
    exec_name: str | None = None
    output: str = "log"
    parameters: Sequence[str | Path | dict[str, object]] = ()
    remappings: Iterable[tuple[str, str]] = ()
    arguments: Sequence[str] = ()


MODULES: MappingProxyType[str, tuple[type, ...]] = MappingProxyType(
    {
        "launch": (LaunchContext, LaunchDescription),
        "launch.actions": (DeclareLaunchArgument, ExecuteProcess, OpaqueFunction, RegisterEventHandler),
        "launch.event_handlers": (OnProcessExit,),
        "launch.events": (),
        "launch.events.process": (ProcessExited,),
        "launch_ros": (),
        "launch_ros.actions": (Node,),
        "launch_ros.parameter_descriptions": (ParameterValue,),
    }
)
"""Where the stock packages have these classes."""


@contextmanager
def importable() -> Iterator[None]:
    """Within the block, these classes are imported by the stock names."""
    before = {name: sys.modules.pop(name, None) for name in MODULES}
    for name, classes in MODULES.items():
        module = ModuleType(name)
        module.__path__ = []  # a package: those below are found in sys.modules
        vars(module).update({one.__name__: one for one in classes})
        sys.modules[name] = module
    try:
        yield
    finally:
        for name, module in before.items():
            del sys.modules[name]
            if module is not None:
                sys.modules[name] = module
