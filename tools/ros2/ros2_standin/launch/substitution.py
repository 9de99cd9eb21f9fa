"""The substitutions of launch files: ``$(var x)``, ``$(find-pkg-share p)``, ``$(eval '...')`` and the others."""

from __future__ import annotations

import os
import shlex
import shutil
import socket
import subprocess
import sys
from collections.abc import Callable
from types import MappingProxyType

from ros2_standin.errors import UserError
from ros2_standin.launch.safe_eval import safe_eval
from ros2_standin.launch.scope import Scope
from ros2_standin.launch.template import Call, Template, parse_template
from ros2_standin.packages import package_executable, package_prefix, package_share


def expand(text: str, scope: Scope) -> str:
    """``text`` with every substitution replaced by its value.

    Raises:
        UserError: a substitution that is not known, has the wrong arguments, or has no value.
    """
    return expand_template(parse_template(text), scope)


def expand_template(template: Template, scope: Scope) -> str:
    """A parsed text with every substitution replaced by its value."""
    return "".join(part if isinstance(part, str) else _call(part, scope) for part in template)


def truth(text: str) -> bool:
    """A condition's value.

    Raises:
        UserError: neither true, false, 1 nor 0.
    """
    word = text.strip().lower()
    if word not in ("true", "false", "1", "0"):
        raise UserError(f"the condition is {text!r}; allowed: true, false, 1, 0")
    return word in ("true", "1")


def _call(call: Call, scope: Scope) -> str:
    if call.name not in _SUBSTITUTIONS:
        hint = " ($(env NAME default) does what optenv did)" if call.name == "optenv" else ""
        names = ", ".join(sorted(_SUBSTITUTIONS))
        raise UserError(f"has the substitution '$({call.name})'{hint}; covered here: {names}")
    least, most, function = _SUBSTITUTIONS[call.name]
    if not least <= len(call.arguments) <= most:
        count = str(least) if least == most else f"{least} to {most}"
        raise UserError(f"has '$({call.name})' with {len(call.arguments)} arguments; allowed: {count}")
    return function(scope, *(expand_template(argument, scope) for argument in call.arguments))


def _var(scope: Scope, name: str, default: str | None = None) -> str:
    value = scope.variables.get(name, default)
    if value is None:
        known = ", ".join(sorted(scope.variables)) or "none"
        raise UserError(f"has '$(var {name})', but there is no such variable; there are: {known}")
    return value


def _env(scope: Scope, name: str, default: str | None = None) -> str:
    value = scope.environment.get(name, default)
    if value is None:
        raise UserError(f"has '$(env {name})', but the environment variable is not set and there is no default")
    return value


def _command(scope: Scope, line: str, on_stderr: str = "fail") -> str:
    if on_stderr not in ("fail", "ignore", "warn", "capture"):
        raise UserError(f"has '$(command)' with {on_stderr!r}; allowed: fail, ignore, warn, capture")
    try:
        done = subprocess.run(
            shlex.split(line),
            env=scope.environment,
            capture_output=True,
            text=True,
            check=False,
            stdin=subprocess.DEVNULL,
        )
    except (OSError, ValueError) as error:
        raise UserError(f"cannot run the command {line!r}: {error}") from error
    if done.returncode or (done.stderr and on_stderr == "fail"):
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise UserError(f"the command {line!r} failed (exit code {done.returncode}): {last}")
    if on_stderr == "warn":
        sys.stderr.write(done.stderr)
    return done.stdout + (done.stderr if on_stderr == "capture" else "")


def _find_exec(scope: Scope, name: str) -> str:
    found = shutil.which(name, path=scope.environment.get("PATH"))
    if not found:
        raise UserError(f"has '$(find-exec {name})', but there is no such executable on the PATH")
    return found


def _anon(scope: Scope, name: str) -> str:
    host = "".join(c if c.isalnum() else "_" for c in socket.gethostname())
    return scope.anonymous.setdefault(name, f"{name}_{host}_{os.getpid()}_{len(scope.anonymous)}")


def _same(a: str, b: str) -> bool:
    """Whether two texts are equal, as truth values or numbers where both are such."""
    for meaning in (truth, float):
        try:
            return meaning(a) == meaning(b)
        except (UserError, ValueError):
            continue
    return a == b


def _word(value: bool) -> str:
    return "true" if value else "false"


_SUBSTITUTIONS: MappingProxyType[str, tuple[int, int, Callable[..., str]]] = MappingProxyType(
    {
        "var": (1, 2, _var),
        "env": (1, 2, _env),
        "command": (1, 2, _command),
        "anon": (1, 1, _anon),
        "eval": (1, 1, lambda _scope, text: str(safe_eval(text))),
        "find-pkg-share": (1, 1, lambda _scope, package: str(package_share(package))),
        "find-pkg-prefix": (1, 1, lambda _scope, package: str(package_prefix(package))),
        "exec-in-pkg": (2, 2, lambda _scope, name, package: str(package_executable(package, name))),
        "find-exec": (1, 1, _find_exec),
        "dirname": (0, 0, lambda scope: str(scope.file.parent)),
        "filename": (0, 0, lambda scope: str(scope.file)),
        "equals": (2, 2, lambda _scope, a, b: _word(_same(a, b))),
        "not-equals": (2, 2, lambda _scope, a, b: _word(not _same(a, b))),
        "not": (1, 1, lambda _scope, a: _word(not truth(a))),
        "and": (2, 2, lambda _scope, a, b: _word(truth(a) and truth(b))),
        "or": (2, 2, lambda _scope, a, b: _word(truth(a) or truth(b))),
        "if": (2, 3, lambda _scope, test, a, b="": a if truth(test) else b),
    }
)
"""Name: least and most arguments, function of the scope and the arguments."""
