"""Python launch files: loaded, and their nodes made into processes."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_standin.errors import UserError
from ros2_standin.launch.parameter_values import ParameterFiles
from ros2_standin.launch.process_tags import OUTPUTS, ros_arguments
from ros2_standin.launch.processes import ProcessSpec
from ros2_standin.launch.python_api import LaunchDescription, Node, ParameterValue, importable
from ros2_standin.launch.scope import Scope
from ros2_standin.packages import package_executable


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
            raise UserError(f"{file}: a Python launch file has a function generate_launch_description")
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


def python_node(node: Node, scope: Scope, files: ParameterFiles) -> ProcessSpec:
    """Process of a node.

    Raises:
        UserError: a value that is not covered, or a package, executable or parameter file that is not there.
    """
    if node.output not in OUTPUTS:
        raise UserError(f"Node has output={node.output!r}; allowed: {', '.join(OUTPUTS)}")
    program = package_executable(node.package, node.executable)
    full_name = f"{scope.namespace}/{node.name}" if node.name else "/**"
    parameters = [
        files.write({name: _plain(name, value) for name, value in entry.items()}, full_name)
        if isinstance(entry, dict)
        else _existing(Path(entry))
        for entry in node.parameters
    ]
    if scope.parameters:
        parameters.insert(0, files.write(scope.parameters))
    ros_args = ros_arguments(node.name or "", scope.namespace, parameters, [*scope.remaps, *node.remappings])
    stdout, stderr = OUTPUTS[node.output]
    return ProcessSpec(
        name=node.exec_name or program.name,
        command=[str(program), "--ros-args", *ros_args],
        environment=dict(scope.environment),
        stdout_to_screen=stdout,
        stderr_to_screen=stderr,
    )


def _plain(name: str, value: object) -> object:
    """A parameter's value; plain text is taken where the stock launch, which reads it as YAML, takes the same."""
    if isinstance(value, ParameterValue):
        return value.value_type(value.value)
    if isinstance(value, str) and not value.isidentifier():
        raise UserError(f"parameter {name} is the text {value!r}, whose type is guessed; make it a ParameterValue")
    return value


def _existing(path: Path) -> Path:
    if not path.is_file():
        raise UserError(f"parameter file '{path}' does not exist")
    return path
