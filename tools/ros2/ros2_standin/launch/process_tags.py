"""The tags ``node`` and ``executable``: from XML to the process to start."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ros2_standin.launch.parameter_values import ParameterFiles, parameter_tree
from ros2_standin.launch.processes import ProcessSpec
from ros2_standin.launch.scope import Scope, join_namespaces
from ros2_standin.launch.substitution import expand, expand_template, truth
from ros2_standin.launch.template import parse_template, split_words
from ros2_standin.launch.xml_tree import Element
from ros2_standin.packages import package_executable

CONDITIONS = ("if", "unless")
_PROCESS = (
    *CONDITIONS, "output", "cwd", "launch-prefix", "respawn", "respawn_delay", "respawn_max_retries", "on_exit",
    "sigterm_timeout", "sigkill_timeout",
)  # fmt: skip
_NODE = (*_PROCESS, "pkg", "exec", "name", "exec_name", "namespace", "args", "ros_args")
_EXECUTABLE = (*_PROCESS, "cmd", "name", "shell")
OUTPUTS = {"screen": (True, True), "both": (True, True), "log": (False, True), "own_log": (False, False)}
"""Which of stdout and stderr each value of ``output`` shows."""


def node_process(node: Element, scope: Scope, files: ParameterFiles) -> ProcessSpec:
    """Process of a ``node``.

    Raises:
        UserError: a tag, attribute or value that is not covered, or a package or executable that is not there.
    """
    node.check(_NODE, ("param", "remap", "env"))
    program = package_executable(expand(node.required("pkg"), scope), expand(node.required("exec"), scope))
    name = expand(node.attributes.get("name", ""), scope)
    namespace = join_namespaces(scope.namespace, expand(node.attributes.get("namespace", ""), scope))
    parameters = _parameter_files(node, scope, files, f"{namespace}/{name}" if name else "/**")
    remaps = [*scope.remaps, *(_pair(child, scope) for child in node.children if child.tag == "remap")]
    ros_args = [*_words(node, "ros_args", scope), *ros_arguments(name, namespace, parameters, remaps)]
    command = [str(program), *_words(node, "args", scope), "--ros-args", *ros_args]
    return _process(node, scope, expand(node.attributes.get("exec_name", program.name), scope), command)


def ros_arguments(
    name: str, namespace: str, parameters: Iterable[Path], remaps: Iterable[tuple[str, str]]
) -> list[str]:
    """Words after ``--ros-args`` that give a node its name, namespace, parameter files and remaps (from, to)."""
    words = ["-r", f"__node:={name}"] if name else []
    words += ["-r", f"__ns:={namespace}"] if namespace else []
    for file in parameters:
        words += ["--params-file", str(file)]
    for source, target in remaps:
        words += ["-r", f"{source}:={target}"]
    return words


def executable_process(executable: Element, scope: Scope) -> ProcessSpec:
    """Process of an ``executable``."""
    executable.check(_EXECUTABLE, ("env",))
    words = _words(executable, "cmd", scope)
    if not words:
        raise executable.error("lacks a command in 'cmd'")
    name = expand(executable.attributes.get("name", Path(words[0]).name), scope)
    if truth(expand(executable.attributes.get("shell", "false"), scope)):
        words = ["/bin/sh", "-c", expand(executable.attributes["cmd"], scope)]
    return _process(executable, scope, name, words)


def _process(element: Element, scope: Scope, name: str, command: list[str]) -> ProcessSpec:
    def value(attribute: str, default: str) -> str:
        return expand(element.attributes.get(attribute, default), scope)

    def seconds(attribute: str, default: float) -> float:
        text = value(attribute, str(default))
        try:
            found = float(text)
        except ValueError:
            found = -1.0
        if not 0.0 <= found < float("inf"):
            raise element.error(f"has {attribute}={text!r}; allowed: a number >= 0 s")
        return found

    output, on_exit, limit = value("output", "log"), value("on_exit", ""), value("respawn_max_retries", "-1")
    if output not in OUTPUTS:
        raise element.error(f"has output={output!r}; allowed: {', '.join(OUTPUTS)}")
    if on_exit not in ("", "shutdown"):
        raise element.error(f"has on_exit={on_exit!r}; allowed: shutdown")
    if not limit.removeprefix("-").isdigit():
        raise element.error(f"has respawn_max_retries={limit!r}; allowed: a whole number, -1 for no limit")
    environment = dict(scope.environment)
    for child in element.children:
        if child.tag == "env":
            child.check(("name", "value"))
            environment[expand(child.required("name"), scope)] = expand(child.required("value"), scope)
    stdout, stderr = OUTPUTS[output]
    return ProcessSpec(
        name=name,
        command=[*_words(element, "launch-prefix", scope), *command],
        environment=environment,
        folder=_folder(element, value("cwd", "")),
        stdout_to_screen=stdout,
        stderr_to_screen=stderr,
        respawn=truth(value("respawn", "false")),
        respawn_delay=seconds("respawn_delay", 0.0),
        respawn_limit=int(limit),
        ends_launch=on_exit == "shutdown",
        interrupt_time=seconds("sigterm_timeout", 5.0),
        terminate_time=seconds("sigkill_timeout", 5.0),
    )


def _folder(element: Element, text: str) -> str | None:
    if text and not Path(text).is_dir():
        raise element.error(f"has cwd={text!r}, which is no folder")
    return text or None


def _words(element: Element, attribute: str, scope: Scope) -> list[str]:
    return [expand_template(word, scope) for word in split_words(parse_template(element.attributes.get(attribute, "")))]


def _pair(remap: Element, scope: Scope) -> tuple[str, str]:
    remap.check(("from", "to"))
    return expand(remap.required("from"), scope), expand(remap.required("to"), scope)


def _parameter_files(node: Element, scope: Scope, files: ParameterFiles, full_name: str) -> list[Path]:
    """Files of the node's parameters; a later one counts over an earlier one, and named values over all files."""
    found = [files.write(scope.parameters)] if scope.parameters else []
    params = [child for child in node.children if child.tag == "param"]
    for param in params:
        if "from" in param.attributes:
            param.check(("from", "allow_substs"))
            path = Path(expand(param.attributes["from"], scope))
            if not path.is_file():
                raise param.error(f"names the file '{path}', which does not exist")
            if truth(expand(param.attributes.get("allow_substs", "false"), scope)):
                path = files.write_text(expand(path.read_text(), scope))
            found.append(path)
    if named := parameter_tree([param for param in params if "from" not in param.attributes], scope):
        found.append(files.write(named, full_name))
    return found
