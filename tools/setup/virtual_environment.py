"""Create the virtual environment .venv with exactly the locked packages and its shell files."""

import os
import re
import shlex
import shutil
import sys
import tempfile
from pathlib import Path

from tools.setup.environment import clean_environment, lock_environment
from tools.setup.layout import (
    LOCK,
    OLD_LOCK,
    OLD_VERSIONS,
    PYTHON,
    REQUIREMENTS,
    ROOT,
    SETUP,
    VENV,
    SetupError,
    tool_pins,
)
from tools.setup.old_versions import with_versions
from tools.setup.progress import Step

NETWORK_HINT = (
    "failed. Packages come from the Python package index. If the network was not reached, name a proxy by HTTPS_PROXY "
    "or a mirror by PIP_INDEX_URL and UV_DEFAULT_INDEX, and run the same command again; what was fetched is kept."
)


def make() -> None:
    """Recreate .venv with exactly the locked packages.

    It is not updated in place by `uv pip sync`: the ROS wheels contain metadata of each other, so that uv would treat
    installed ones as remnants and remove their files.

    Raises:
        SetupError: a step failed.
    """
    shutil.rmtree(VENV, ignore_errors=True)
    with Step(f"Python {sys.version_info.major}.{sys.version_info.minor} in .venv", NETWORK_HINT) as step:
        _make_with_uv(step, VENV)
    packages = len(re.findall(r"^\S+==", LOCK.read_text(encoding="utf-8"), re.MULTILINE))
    with Step(f"{packages} pinned packages", NETWORK_HINT) as step:
        step.run(
            [VENV / "bin" / "uv", "pip", "install", "--python", PYTHON, "--require-hashes", "--no-build-isolation",
             "--compile-bytecode", "--link-mode", "copy", "-r", LOCK],
            clean_environment() | {"UV_PYTHON_DOWNLOADS": "never", "UV_NO_PROGRESS": "1"},
        )  # fmt: skip


def write_shell_files() -> None:
    """Write .venv/local_setup.*, which install/setup.bash reads first, and the `ros2` launcher."""
    text = (
        "# Written by the set-up.\n"
        f"_continuum_root={shlex.quote(str(ROOT))}\n"
        f"_continuum_base_python={shlex.quote(_base_python())}\n"
        '. "$_continuum_root/tools/setup/environment.sh"\n'
    )
    for shell in ("sh", "bash"):
        (VENV / f"local_setup.{shell}").write_text(text, encoding="utf-8")
    launcher = VENV / "bin" / "ros2"
    launcher.unlink(missing_ok=True)
    launcher.symlink_to(os.path.relpath(SETUP / "ros2", launcher.parent))


def lock() -> None:
    """Resolve requirements.in, also with old versions for `make check-old`, and lock the extra packages of tools.

    Raises:
        SetupError: there is no solution, or the network failed.
    """
    with tempfile.TemporaryDirectory() as folder, Step("requirements.lock", NETWORK_HINT) as step:
        uv, old = Path(folder) / "uv" / "bin" / "uv", Path(folder) / "old.in"
        _make_with_uv(step, Path(folder) / "uv")
        _compile(step, uv, REQUIREMENTS.relative_to(ROOT), LOCK)
        old.write_text(with_versions(REQUIREMENTS.read_text(), OLD_VERSIONS.read_text()))
        _compile(step, uv, old, OLD_LOCK, "--no-annotate")
        for pins in tool_pins():
            _compile(step, uv, pins.relative_to(ROOT), pins.with_suffix(".txt"), "--no-deps")


def _compile(step: Step, uv: Path, requirements: Path, locked: Path, *options: str) -> None:
    step.run(
        [uv, "pip", "compile", "--quiet", "--no-config", "--upgrade", "--generate-hashes", "--no-emit-index-url",
         "--no-emit-find-links", "--python", sys.executable, "--custom-compile-command", "make lock", *options,
         requirements, "--output-file", locked],
        lock_environment(),
    )  # fmt: skip


def _make_with_uv(step: Step, folder: Path) -> None:
    """Create a virtual environment with the locked uv, and with setuptools for source packages."""
    step.run([sys.executable, "-m", "venv", folder], clean_environment())
    with tempfile.TemporaryDirectory() as temporary:
        first = Path(temporary) / "first.lock"
        first.write_text(_locked("uv") + _locked("setuptools"), encoding="utf-8")
        step.run(
            [folder / "bin" / "python3", "-m", "pip", "install", "--require-hashes", "--no-deps",
             "--disable-pip-version-check", "-r", first],
            clean_environment(),
        )  # fmt: skip


def _locked(name: str) -> str:
    """Return the entry of one package in the lock: its version and hashes."""
    entry = re.search(rf"^{re.escape(name)}==.*(?:\n {{4}}--hash=.*)+", LOCK.read_text(encoding="utf-8"), re.MULTILINE)
    if entry is None:
        raise SetupError(f"{LOCK} has no entry for {name}; restore the file or make it anew")
    return entry.group() + "\n"


def _base_python() -> str:
    """Return an interpreter for colcon's shell files, which fail if its path contains a space."""
    candidates = [os.path.realpath(sys.executable), sys.executable, "/usr/bin/python3"]
    return next((path for path in candidates if " " not in path), sys.executable)
