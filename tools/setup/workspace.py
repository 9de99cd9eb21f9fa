"""The ROS workspace: the packages of the checkout, built by colcon into build/, install/ and log/."""

import shutil
import sysconfig
from collections.abc import Sequence
from pathlib import Path

from tools.setup.environment import venv_environment
from tools.setup.layout import BUILD, INSTALL, LOG, PYTHON, SETUP, VENV, SetupError, package_folders
from tools.setup.progress import Step


def check_build_tools() -> None:
    """Raises: SetupError: a compiler or Python's headers are missing."""
    missing = [tool for tool in ("gcc", "g++", "make") if shutil.which(tool) is None]
    if not (Path(sysconfig.get_path("include")) / "Python.h").exists():
        missing.append("the headers of Python 3.12 (python3.12-dev)")
    if missing:
        raise SetupError(
            f"missing on this machine: {', '.join(missing)}; on Debian and Ubuntu: apt install build-essential"
        )


LIBRARY = "continuum"
_BUILD_HINT = "does not build; the lines above say which and why."

WARM_UPS = {
    "solver and integrator": ("continuum.kinematics.compiled.warm_up", "continuum.dynamics.warm_up"),
    "a first diagnosis": ("continuum.discovery.warm_up",),
}
"""Modules that fill the caches of numba and of compiled equations, so that nodes and diagnoses need not compile."""


def build(names: list[str], compiled: bool) -> None:
    """Build the packages ``names``, and compile the library's code unless it is ``compiled``, at the same time.

    The library comes first: its code is compiled where it is installed.

    Raises:
        SetupError: a package does not build, or code does not compile.
    """
    _remove_dead_links()
    library = [name for name in names if name == LIBRARY]
    if library:
        with Step("the library", _BUILD_HINT) as step:
            step.run(_colcon(library), venv_environment())
    rest = [name for name in names if name != LIBRARY]
    titles = [f"{len(rest)} ROS package{'s' if len(rest) > 1 else ''}"] if rest else []
    commands = [_colcon(rest)] if rest else []
    if not compiled:
        titles += [f"{what} compiled" for what in WARM_UPS]
        commands += [_python(modules) for modules in WARM_UPS.values()]
    if commands:
        with Step(", ".join(titles), _BUILD_HINT) as step:
            step.run_together(commands, venv_environment())
    _free_scripts()


def _colcon(names: list[str]) -> list[str | Path]:
    """Return the command that builds packages; Python packages are linked, so changes of their files need no build."""
    return [
        PYTHON, VENV / "bin" / "colcon", "--log-base", LOG, "build", "--symlink-install",
        "--base-paths", *package_folders(), "--packages-select", *names,
        "--build-base", BUILD, "--install-base", INSTALL, "--event-handlers", "console_cohesion+",
        "--cmake-args", "-DBUILD_TESTING=OFF", "-DCMAKE_BUILD_TYPE=Release", f"-DPython3_EXECUTABLE={PYTHON}",
        f"-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES={SETUP / 'imported_include_dirs.cmake'}",
    ]  # fmt: skip


def _python(modules: Sequence[str]) -> list[str | Path]:
    """Return the command that runs modules of the installed library, one after the other."""
    return ["bash", "-c", " && ".join(["source install/setup.bash", *(f"python3 -m {name}" for name in modules)])]


def remove() -> None:
    """Remove everything that was built."""
    for folder in (BUILD, INSTALL):
        shutil.rmtree(folder, ignore_errors=True)


def _remove_dead_links() -> None:
    """Remove links to files that the checkout no longer has, which make colcon fail."""
    for folder in (BUILD, INSTALL):
        for path in folder.rglob("*"):
            if path.is_symlink() and not path.exists():
                path.unlink()


def _free_scripts() -> None:
    """Let scripts find Python on the PATH, according to setup.cfg's ``[build_scripts] executable``.

    A linked build ignores this setting and writes the interpreter's path, which fails if it contains a space.
    """
    for script in INSTALL.glob("*/lib/*/*"):
        package = script.parents[2].name
        if script.parent.name == package and script.is_file() and not script.is_symlink():
            first_line, newline, rest = script.read_bytes().partition(b"\n")
            if first_line.startswith(b"#!"):
                script.write_bytes(b"#!/usr/bin/env python3" + newline + rest)
