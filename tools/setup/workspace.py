"""The ROS workspace: the packages of the checkout, built by colcon into build/, install/ and log/."""

import shutil
import sysconfig
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


def build(names: list[str]) -> None:
    """Build the packages ``names``; Python packages are linked, so that changes of their files need no build.

    Raises:
        SetupError: a package does not build.
    """
    _remove_dead_links()
    title = f"{len(names)} ROS package{'s' if len(names) > 1 else ''}"
    with Step(title, "does not build; the lines above say which and why.") as step:
        step.run(
            [PYTHON, VENV / "bin" / "colcon", "--log-base", LOG, "build", "--symlink-install",
             "--base-paths", *package_folders(), "--packages-select", *names,
             "--build-base", BUILD, "--install-base", INSTALL, "--event-handlers", "console_cohesion+",
             "--cmake-args", "-DBUILD_TESTING=OFF", "-DCMAKE_BUILD_TYPE=Release", f"-DPython3_EXECUTABLE={PYTHON}",
             f"-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES={SETUP / 'imported_include_dirs.cmake'}"],
            venv_environment(),
        )  # fmt: skip
    _free_scripts()


WARM_UPS = {
    "solver and integrator": ("continuum.kinematics.compiled.warm_up", "continuum.dynamics.warm_up"),
    "a first diagnosis": ("continuum.discovery.warm_up",),
}


def compile_solver() -> None:
    """Fill the caches of numba and of compiled equations, so that nodes and diagnoses need not compile at run time.

    Raises:
        SetupError: the inverse kinematics solver, the integrator or the code of a diagnosis does not compile.
    """
    for what, modules in WARM_UPS.items():
        with Step(f"{what}, compiled", "does not compile; the lines above say why.") as step:
            step.run(
                ["bash", "-c", " && ".join(["source install/setup.bash", *(f"python3 -m {name}" for name in modules)])],
                venv_environment(),
            )


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
