"""What `source install/setup.bash` adds to a shell, whatever the shell came with."""

import shlex
import subprocess
from pathlib import Path

import pytest

from tools.setup.environment import clean_environment, lock_environment
from tools.setup.layout import SETUP

ROOT = "/some where/check out"


def sourced(shell: str, times: int = 1, **given: str) -> dict[str, str]:
    """The environment after sourcing ``environment.sh`` under ``set -u``."""
    lines = f"_continuum_root='{ROOT}'; _continuum_base_python=/base; . {shlex.quote(str(SETUP / 'environment.sh'))}\n"
    result = subprocess.run(
        [shell, "-c", f"set -eu\n{lines * times}env -0"],
        env={"PATH": "/usr/bin:/bin"} | given, capture_output=True, text=True, check=True, timeout=60,
    )  # fmt: skip
    return dict(line.split("=", 1) for line in result.stdout.split("\0") if line)


@pytest.mark.parametrize("shell", ["sh", "bash"])
def test_the_virtual_environment_comes_first_and_once(shell: str) -> None:
    path = f"/usr/bin:{ROOT}/.venv/bin:/bin:{ROOT}/.venv/bin"
    environment = sourced(shell, times=2, PATH=path, VIRTUAL_ENV="/other", CONDA_PREFIX="/conda")
    assert environment["PATH"] == f"{ROOT}/.venv/bin:/usr/bin:/bin"
    assert environment["AMENT_PREFIX_PATH"] == environment["CMAKE_PREFIX_PATH"] == f"{ROOT}/.venv"


def test_left_overs_of_another_python_are_gone() -> None:
    environment = sourced("sh", _ROS_WHEELS_BOOTSTRAP_COMPLETE="1", PYTHONHOME="/other")
    assert not {"_ROS_WHEELS_BOOTSTRAP_COMPLETE", "PYTHONHOME"} & environment.keys()
    assert not [name for name in environment if name.startswith("_continuum")]


def test_discovery_stays_on_this_host_unless_the_user_says_otherwise() -> None:
    assert sourced("sh")["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "LOCALHOST"
    assert sourced("sh", ROS_AUTOMATIC_DISCOVERY_RANGE="SUBNET")["ROS_AUTOMATIC_DISCOVERY_RANGE"] == "SUBNET"


def test_users_middleware_settings_are_kept() -> None:
    users = {"RMW_IMPLEMENTATION": "rmw_other", "FASTRTPS_DEFAULT_PROFILES_FILE": "/mine.xml"}
    assert users.items() <= sourced("sh", **users).items()
    profiles = sourced("sh")["FASTRTPS_DEFAULT_PROFILES_FILE"].removeprefix(ROOT)
    assert (Path(SETUP).parent.parent / profiles.lstrip("/")).is_file()


def test_a_build_sees_neither_other_pythons_nor_the_flags_of_make(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("PYTHONPATH", "VIRTUAL_ENV", "MAKEFLAGS", "_ROS_WHEELS_BOOTSTRAP_COMPLETE"):
        monkeypatch.setenv(name, "x")
    monkeypatch.setenv("HTTPS_PROXY", "kept")
    assert not {"PYTHONPATH", "VIRTUAL_ENV", "MAKEFLAGS", "_ROS_WHEELS_BOOTSTRAP_COMPLETE"} & clean_environment().keys()
    assert clean_environment()["HTTPS_PROXY"] == "kept"


def test_a_lock_does_not_depend_on_local_indexes(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("PIP_FIND_LINKS", "UV_FIND_LINKS", "UV_DEFAULT_INDEX", "UV_EXTRA_INDEX_URL"):
        monkeypatch.setenv(name, "x")
    assert not [name for name in lock_environment() if name.startswith(("PIP_", "UV_")) and name != "UV_CACHE_DIR"]
