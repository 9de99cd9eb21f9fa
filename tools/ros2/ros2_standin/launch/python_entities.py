"""Entities of Python launch files, evaluated in their order."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Protocol

from ros2_standin.errors import UserError
from ros2_standin.launch.argument import Argument
from ros2_standin.launch.parameter_values import ParameterFiles
from ros2_standin.launch.processes import LogLine, ProcessSpec
from ros2_standin.launch.python_api import (
    DeclareLaunchArgument,
    IncludeLaunchDescription,
    LaunchContext,
    Node,
    OpaqueFunction,
    ProcessExited,
    RegisterEventHandler,
)
from ros2_standin.launch.python_file import errors_in_one_line, load, python_node
from ros2_standin.launch.scope import Scope


class Interpreter(Protocol):
    """What the entities of a file are handed to; attributes and methods as in `interpreter.Interpreter`."""

    files: ParameterFiles
    only_arguments: bool
    steps: list[ProcessSpec | LogLine]
    exit_handlers: list[Callable[[ProcessExited, LaunchContext], object]]

    def declare(self, argument: Argument, scope: Scope) -> None: ...

    def file(self, file: Path, scope: Scope) -> None: ...


def evaluate(interpreter: Interpreter, file: Path, scope: Scope) -> None:
    """Hand what a Python launch file asks for to the interpreter.

    Raises:
        UserError: something in it is wrong or not covered.
    """
    _evaluate(load(file).initial_entities, interpreter, scope)


def _evaluate(entities: Iterable[object], interpreter: Interpreter, scope: Scope) -> None:
    for entity in entities:
        match entity:
            case DeclareLaunchArgument():
                interpreter.declare(_argument(entity), scope)
            case _ if interpreter.only_arguments:
                pass
            case OpaqueFunction():
                with errors_in_one_line():
                    further = entity.function(LaunchContext(scope.variables)) or ()
                _evaluate(further, interpreter, scope)
            case RegisterEventHandler():
                interpreter.exit_handlers.append(entity.event_handler.on_exit)
            case IncludeLaunchDescription():
                scope.variables.update(entity.launch_arguments)
                interpreter.file(Path(entity.launch_description_source.launch_file_path), scope)
            case Node():
                interpreter.steps.append(python_node(entity, scope, interpreter.files))
            case _:
                raise UserError(f"{scope.file}: {type(entity).__name__} is not covered here")


def _argument(entity: DeclareLaunchArgument) -> Argument:
    return Argument(entity.name, entity.default_value, entity.description or "", list(entity.choices or ()))
