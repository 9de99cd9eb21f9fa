"""Evaluates launch files, tag by tag or entity by entity, to the processes and log lines that they ask for."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from ros2_standin.errors import UserError
from ros2_standin.launch.argument import Argument
from ros2_standin.launch.parameter_values import ParameterFiles, parameter_tree
from ros2_standin.launch.process_tags import CONDITIONS, executable_process, node_process
from ros2_standin.launch.processes import LogLine, ProcessSpec
from ros2_standin.launch.python_api import LaunchContext, ProcessExited
from ros2_standin.launch.python_entities import evaluate
from ros2_standin.launch.scope import Scope
from ros2_standin.launch.substitution import expand, truth
from ros2_standin.launch.xml_tree import Element, PlacedError, read_xml

_DEEPEST = 50
"""Depth of includes that can only be a circle."""

_LOG_LEVELS = ("debug", "info", "warning", "error")


@dataclass
class Interpreter:
    """What evaluating launch files gives.

    Attributes:
        files: where parameters for nodes are written.
        given: values from the command line, and from includes.
        only_arguments: collect the arguments and start nothing; a missing one is no error then.
        arguments: every ``arg`` that was met, by name.
        steps: processes and log lines in their order.
        exit_handlers: functions of Python launch files that are called whenever a process has ended.
    """

    files: ParameterFiles
    given: Mapping[str, str]
    only_arguments: bool = False
    arguments: dict[str, Argument] = field(default_factory=dict)
    steps: list[ProcessSpec | LogLine] = field(default_factory=list)
    exit_handlers: list[Callable[[ProcessExited, LaunchContext], object]] = field(default_factory=list)
    _depth: int = 0

    def run(self, file: Path) -> None:
        """Evaluate a launch file.

        Raises:
            UserError: something in it is wrong or not covered; names file, line and tag.
        """
        self.file(file, Scope(dict(os.environ), file, dict(self.given)))

    def file(self, file: Path, scope: Scope) -> None:
        """Evaluate a launch file within a scope."""
        previous, scope.file = scope.file, file.absolute()
        self._depth += 1
        if self._depth > _DEEPEST:
            raise UserError(f"{file}: includes go round in a circle")
        if file.name.endswith(".xml"):
            self._xml_file(file, scope)
        elif file.name.endswith(".py"):
            evaluate(self, file, scope)
        else:
            raise UserError(f"{file}: this stand-in covers launch files in XML and, in small part, in Python")
        self._depth -= 1
        scope.file = previous

    def _xml_file(self, file: Path, scope: Scope) -> None:
        root = read_xml(file)
        if root.tag != "launch":
            raise root.error("is not the tag that a launch file begins with; allowed: launch")
        root.check(("version",), _TAGS)
        self._tags(root.children, scope)

    def _tags(self, elements: list[Element], scope: Scope) -> None:
        for element in elements:
            with _placed(element):
                if self._wanted(element, scope):
                    _TAGS[element.tag](self, element, scope)

    def _wanted(self, element: Element, scope: Scope) -> bool:
        if all(name in element.attributes for name in CONDITIONS):
            raise element.error("has both 'if' and 'unless'")
        if self.only_arguments:
            return True
        if "if" in element.attributes:
            return truth(expand(element.attributes["if"], scope))
        return "unless" not in element.attributes or not truth(expand(element.attributes["unless"], scope))

    def _arg(self, element: Element, scope: Scope) -> None:
        element.check(("name", "default", "description", *CONDITIONS), ("choice",))
        name = expand(element.required("name"), scope)
        default = element.attributes.get("default")
        default = None if default is None else expand(default, scope)
        choices = [expand(choice.required("value"), scope) for choice in element.children]
        self.declare(Argument(name, default, expand(element.attributes.get("description", ""), scope), choices), scope)

    def declare(self, argument: Argument, scope: Scope) -> None:
        """Take an argument up, and give it its default where it has no value.

        Raises:
            UserError: it has neither, or a value that is not among its choices.
        """
        name = argument.name
        if self._depth == 1 or name not in scope.variables:
            self.arguments.setdefault(name, argument)
        if name not in scope.variables:
            if argument.default is None and not self.only_arguments:
                given = ", ".join(self.given) or "none"
                about = f" (description: {argument.description!r})" if argument.description else ""
                raise UserError(f"lacks a value: missing required argument '{name}'{about}, given: {given}")
            scope.variables[name] = argument.default or ""
        if argument.choices and scope.variables[name] not in argument.choices and not self.only_arguments:
            raise UserError(f"'{name}' is {scope.variables[name]!r}; allowed: {', '.join(argument.choices)}")

    def _let(self, element: Element, scope: Scope) -> None:
        element.check(("name", "value", *CONDITIONS))
        scope.variables[expand(element.required("name"), scope)] = expand(element.required("value"), scope)

    def _group(self, element: Element, scope: Scope) -> None:
        element.check(("scoped", *CONDITIONS), _TAGS)
        scoped = truth(expand(element.attributes.get("scoped", "true"), scope))
        self._tags(element.children, scope.inner() if scoped else scope)

    def _include(self, element: Element, scope: Scope) -> None:
        element.check(("file", *CONDITIONS), ("arg", "let"))
        try:
            file = Path(expand(element.required("file"), scope))
        except UserError:
            if self.only_arguments:
                return
            raise
        # As in the stock launch, what an include is given stays set after it, unless a group is around it.
        for child in element.children:
            child.check(("name", "value"))
            scope.variables[expand(child.required("name"), scope)] = expand(child.required("value"), scope)
        self.file(file, scope)

    def _node(self, element: Element, scope: Scope) -> None:
        if not self.only_arguments:
            self.steps.append(node_process(element, scope, self.files))

    def _executable(self, element: Element, scope: Scope) -> None:
        if not self.only_arguments:
            self.steps.append(executable_process(element, scope))

    def _set_env(self, element: Element, scope: Scope) -> None:
        element.check(("name", "value", *CONDITIONS))
        scope.environment[expand(element.required("name"), scope)] = expand(element.required("value"), scope)

    def _unset_env(self, element: Element, scope: Scope) -> None:
        element.check(("name", *CONDITIONS))
        scope.environment.pop(expand(element.required("name"), scope), None)

    def _push_namespace(self, element: Element, scope: Scope) -> None:
        element.check(("namespace", *CONDITIONS))
        scope.push_namespace(expand(element.required("namespace"), scope))

    def _set_remap(self, element: Element, scope: Scope) -> None:
        element.check(("from", "to", *CONDITIONS))
        scope.remaps.append((expand(element.required("from"), scope), expand(element.required("to"), scope)))

    def _set_parameter(self, element: Element, scope: Scope) -> None:
        plain = Element(
            "param", {k: v for k, v in element.attributes.items() if k not in CONDITIONS}, element.file, element.line
        )
        scope.parameters.update(parameter_tree([plain], scope))

    def _log(self, element: Element, scope: Scope) -> None:
        element.check(("message", "level", *CONDITIONS))
        level = element.attributes.get("level", "info").lower()
        if level not in _LOG_LEVELS:
            raise element.error(f"has the level {level!r}; allowed: {', '.join(_LOG_LEVELS)}")
        self.steps.append(LogLine(level, expand(element.required("message"), scope)))


_TAGS: dict[str, Callable[[Interpreter, Element, Scope], None]] = {
    "arg": Interpreter._arg,
    "let": Interpreter._let,
    "group": Interpreter._group,
    "include": Interpreter._include,
    "node": Interpreter._node,
    "executable": Interpreter._executable,
    "set_env": Interpreter._set_env,
    "unset_env": Interpreter._unset_env,
    "push_ros_namespace": Interpreter._push_namespace,
    "push-ros-namespace": Interpreter._push_namespace,
    "set_remap": Interpreter._set_remap,
    "set_parameter": Interpreter._set_parameter,
    "log": Interpreter._log,
}


@contextmanager
def _placed(element: Element) -> Iterator[None]:
    """Errors that do not tell a place yet get this element's."""
    try:
        yield
    except PlacedError:
        raise
    except UserError as error:
        raise element.error(str(error)) from error
