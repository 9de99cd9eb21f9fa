"""Launch files: loaded, and evaluated entity by entity to the processes that they ask for."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import yaml

from ros2_standin.errors import UserError
from ros2_standin.launch.processes import ProcessSpec
from ros2_standin.launch.python_api import (
    DeclareLaunchArgument,
    ExecuteProcess,
    LaunchContext,
    LaunchDescription,
    Node,
    OnProcessExit,
    OpaqueFunction,
    ParameterValue,
    RegisterEventHandler,
    importable,
)
from ros2_standin.packages import package_executable

OUTPUTS = {"screen": (True, True), "both": (True, True), "log": (False, True), "own_log": (False, False)}
"""Which of stdout and stderr each value of ``output`` shows."""


class ParameterFiles:
    """Temporary parameter files, gone when the block ends."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(prefix="launch_params_")
        self._count = 0

    def __enter__(self) -> ParameterFiles:
        return self

    def __exit__(self, *_exception: object) -> None:
        self._folder.cleanup()

    def write(self, parameters: Mapping[str, object], node: str) -> Path:
        """A file with the parameters of ``node`` (full name, or a pattern)."""
        self._count += 1
        path = Path(self._folder.name) / f"{self._count}.yaml"
        path.write_text(yaml.safe_dump({node: {"ros__parameters": _plain(parameters)}}, sort_keys=False))
        return path


@dataclass
class LaunchFile:
    """What a launch file asks for.

    Args:
        files: where parameters for nodes are written.
        given: values of its arguments.
        only_arguments: collect the arguments and start nothing; a missing one is no error then.

    Attributes:
        arguments: by name.
        processes: in their order.
        exit_handlers: what is called when a process has ended.
    """

    files: ParameterFiles
    given: Mapping[str, str]
    only_arguments: bool = False
    arguments: dict[str, DeclareLaunchArgument] = field(default_factory=dict)
    processes: list[ProcessSpec] = field(default_factory=list)
    exit_handlers: list[OnProcessExit] = field(default_factory=list)

    def read(self, file: Path) -> None:
        """Evaluate a file.

        Raises:
            UserError: something in it is wrong or not covered.
        """
        if file.suffix != ".py":
            raise UserError(f"{file}: this stand-in covers launch files in Python alone, *.launch.py")
        self._evaluate(load(file).initial_entities, LaunchContext(dict(self.given)), file)

    def _evaluate(self, entities: Iterable[object], context: LaunchContext, file: Path) -> None:
        for entity in entities:
            match entity:
                case DeclareLaunchArgument():
                    self._declare(entity, context.launch_configurations)
                case _ if self.only_arguments:
                    pass
                case OpaqueFunction():
                    with errors_in_one_line():
                        further = entity.function(context) or ()
                    self._evaluate(further, context, file)
                case RegisterEventHandler():
                    self.exit_handlers.append(entity.event_handler)
                case Node():
                    self.processes.append(node_process(entity, self.files))
                case ExecuteProcess():
                    self.processes.append(program_process(entity))
                case _:
                    raise UserError(f"{file}: {type(entity).__name__} is not covered here")

    def _declare(self, argument: DeclareLaunchArgument, values: dict[str, str]) -> None:
        """Take an argument up, and give it its default where it has no value."""
        name, choices = argument.name, list(argument.choices or ())
        self.arguments[name] = argument
        if self.only_arguments:
            return
        if values.setdefault(name, argument.default_value) is None:
            given = ", ".join(self.given) or "none"
            raise UserError(f"missing required argument '{name}' ({argument.description}), given: {given}")
        if choices and values[name] not in choices:
            raise UserError(f"'{name}' is {values[name]!r}; allowed: {', '.join(choices)}")


def load(file: Path) -> LaunchDescription:
    """What ``generate_launch_description`` of a file gives.

    Raises:
        UserError: the file cannot be read, or its code fails.
    """
    try:
        code = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise UserError(f"{file}: {getattr(error, 'strerror', None) or error}") from error
    names: dict[str, object] = {"__name__": "launch_file", "__file__": str(file)}
    with importable(), errors_in_one_line():
        exec(compile(code, file, "exec"), names)  # noqa: S102  (a launch file is a program)
        if not callable(make := names.get("generate_launch_description")):
            raise UserError(f"{file}: a launch file has a function generate_launch_description")
        return make()


@contextmanager
def errors_in_one_line() -> Iterator[None]:
    """What a launch file's code raises becomes one line, in the stock launch's words.

    Raises:
        UserError: the block raised something.
    """
    try:
        yield
    except UserError:
        raise
    except Exception as error:  # the code is the user's, and may raise anything
        raise UserError(
            f"Caught exception in launch (see debug for traceback): {' '.join(str(error).split())}"
        ) from error


def node_process(node: Node, files: ParameterFiles) -> ProcessSpec:
    """Process of a node.

    Raises:
        UserError: a value that is not covered, or a package, executable or parameter file that is not there.
    """
    stdout, stderr = _shown(node)
    program = package_executable(node.package, node.executable)
    namespace = f"/{node.namespace.strip('/')}" if node.namespace else ""
    words = ["-r", f"__node:={node.name}"] if node.name else []
    words += ["-r", f"__ns:={namespace}"] if namespace else []
    full_name = f"{namespace}/{node.name}" if node.name else "/**"
    for entry in node.parameters:
        file = files.write(entry, full_name) if isinstance(entry, dict) else Path(entry)
        if not file.is_file():
            raise UserError(f"parameter file '{file}' does not exist")
        words += ["--params-file", str(file)]
    for source, target in node.remappings:
        words += ["-r", f"{source}:={target}"]
    command = [str(program), *node.arguments, "--ros-args", *words]
    return ProcessSpec(node.exec_name or program.name, command, stdout, stderr, action=node)


def program_process(program: ExecuteProcess) -> ProcessSpec:
    """Process of a program that is no node."""
    stdout, stderr = _shown(program)
    times = float(program.sigterm_timeout), float(program.sigkill_timeout)
    return ProcessSpec(program.name or Path(program.cmd[0]).name, list(program.cmd), stdout, stderr, *times, program)


def _shown(entity: Node | ExecuteProcess) -> tuple[bool, bool]:
    if entity.output not in OUTPUTS:
        raise UserError(f"{type(entity).__name__} has output={entity.output!r}; allowed: {', '.join(OUTPUTS)}")
    return OUTPUTS[entity.output]


def _plain(parameters: Mapping[str, object]) -> dict[str, object]:
    """Values of parameters; plain text is taken where the stock launch, which reads it as YAML, takes the same."""
    plain: dict[str, object] = {}
    for name, value in parameters.items():
        if isinstance(value, Mapping):
            plain[name] = _plain(value)
        elif isinstance(value, ParameterValue):
            plain[name] = value.value_type(value.value)
        elif isinstance(value, str) and not value.isidentifier():
            raise UserError(f"parameter {name} is the text {value!r}, whose type is guessed; make it a ParameterValue")
        else:
            plain[name] = value
    return plain
