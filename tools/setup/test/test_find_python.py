"""The search for an interpreter looks past what does not run, and past virtual environments."""

import os
import subprocess
import sys
from pathlib import Path

from tools.setup.layout import SETUP, VENV


def search(**environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["sh", SETUP / "find_python.sh"], env=environment, capture_output=True, text=True, check=False, timeout=60
    )


def script(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return path


def test_a_shim_that_fails_is_passed_over_for_one_that_works(tmp_path: Path) -> None:
    base = os.path.realpath(sys.executable)
    shim = script(tmp_path / "sh ims" / "python3.12", "echo 'python3.12: command not found' >&2; exit 127")
    script(tmp_path / "py env" / "versions" / "3.12.9" / "bin" / "python", f'exec "{base}" "$@"')
    found = search(PATH=f"{shim.parent}:/usr/bin:/bin", HOME=str(tmp_path), PYENV_ROOT=str(tmp_path / "py env"))
    assert found.returncode == 0, found.stderr
    version = subprocess.run([found.stdout.strip(), "-V"], capture_output=True, text=True, check=True, timeout=60)
    assert version.stdout.startswith("Python 3.12.")


def test_a_virtual_environment_leads_to_its_base(tmp_path: Path) -> None:
    found = search(
        PATH="/usr/bin:/bin",
        HOME=str(tmp_path),
        PYTHON=str(VENV / "bin" / "python3"),
        _ROS_WHEELS_BOOTSTRAP_COMPLETE="1",
    )
    assert found.returncode == 0, found.stderr
    assert not Path(found.stdout.strip()).is_relative_to(VENV)


def test_other_versions_and_programs_are_refused(tmp_path: Path) -> None:
    """A program that only claims to be Python 3.12 is not taken."""
    liar = script(tmp_path / "python3.12", "echo /bin/sh-not-there")
    found = search(PATH=f"{tmp_path}:/usr/bin:/bin", HOME=str(tmp_path), PYTHON=str(liar))
    assert "not-there" not in found.stdout
    assert found.returncode == 0 or "apt install python3.12" in found.stderr
