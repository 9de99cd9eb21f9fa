"""Look up the names in the rows where they are defined: library, the command's parser, Makefile, packages, tests."""

from __future__ import annotations

import ast
import inspect
import io
import pkgutil
import re
from collections.abc import Iterable
from contextlib import redirect_stderr, redirect_stdout
from functools import cache
from pathlib import Path

from continuum.cli import main as continuum_command
from continuum.errors import ContinuumError
from tools.docs.equations.rows import Row

ROOT = Path(__file__).resolve().parents[3]


class RowError(ContinuumError):
    """A row contains a name that does not exist, or no name."""

    def __init__(self, row: Row, problem: str) -> None:
        super().__init__(f"{row.number}: {problem}")


def check_rows(rows: Iterable[Row], root: Path = ROOT) -> None:
    """Look up every name and every test.

    Raises:
        RowError: a name does not exist, or a row has no name and no reason.
    """
    for row in rows:
        if not (row.names and row.tests) and not row.reason:
            raise RowError(row, "it names no counterpart or no test, and gives no reason")
        problems = [problem_of_name(name, root) for name in row.names]
        problems += [problem_of_test(test, root) for test in row.tests]
        for problem in filter(None, problems):
            raise RowError(row, problem)


def problem_of_name(name: str, root: Path = ROOT) -> str:
    """Describe why a name is invalid; empty if it exists."""
    match name.split():
        case ["continuum", *words] if words:
            found = _has_command(tuple(words))
        case ["make", target]:
            found = re.search(rf"^{re.escape(target)}:", _text(root / "Makefile"), re.MULTILINE) is not None
        case ["ros2", "run", package, executable]:
            found = executable in _executables(root / package / "setup.py")
        case ["ros2", "launch", package, file]:
            found = (root / package / "launch" / file).is_file()
        case [path] if "/" in path:
            found = (root / path).is_file()
        case [dotted] if re.fullmatch(r"[A-Za-z_]\w*(\.\w+)+", dotted):
            found = _is_defined(dotted)
        case _:
            return f"{name!r} is no dotted name, command or path"
    return "" if found else f"there is no `{name}`"


def problem_of_test(test: str, root: Path = ROOT) -> str:
    """Describe why a test is invalid; empty if pytest would run it."""
    path, _, function = test.partition("::")
    return "" if function in _tests(root / path) else f"there is no test `{test}`"


def _is_defined(dotted: str) -> bool:
    """Return whether the name is a function, class or constant; a module alone is too unspecific."""
    try:
        return not inspect.ismodule(pkgutil.resolve_name(dotted))
    except (ImportError, AttributeError):
        return False


@cache
def _has_command(words: tuple[str, ...]) -> bool:
    """Return whether the parser of `continuum` shows the usage of exactly this command."""
    out = io.StringIO()
    with redirect_stdout(out), redirect_stderr(io.StringIO()):
        try:
            continuum_command([*words, "--help"])
        except SystemExit as end:
            return end.code == 0 and out.getvalue().startswith(f"usage: {' '.join(('continuum', *words))} ")
    return False


@cache
def _executables(setup: Path) -> frozenset[str]:
    """Return the names of the console scripts of a package's setup.py."""
    pairs = [node for node in ast.walk(ast.parse(_text(setup))) if isinstance(node, ast.Dict)]
    scripts = [
        value
        for pair in pairs
        for key, value in zip(pair.keys, pair.values, strict=True)
        if isinstance(key, ast.Constant) and key.value == "console_scripts"
    ]
    return frozenset(line.partition("=")[0].strip() for script in scripts for line in ast.literal_eval(script))


@cache
def _tests(path: Path) -> frozenset[str]:
    """Return the names of the test functions of a module; empty if pytest would not collect it."""
    if not re.fullmatch(r"test_\w+\.py", path.name):
        return frozenset()
    body = ast.parse(_text(path)).body
    return frozenset(node.name for node in body if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"))


def _text(path: Path) -> str:
    """Return the text of a file; empty if it does not exist."""
    return path.read_text(encoding="utf-8") if path.is_file() else ""
