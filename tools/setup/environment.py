"""The environment of every command that the set-up starts: the caller's, without what could change the result."""

import os

from tools.setup.layout import VENV

FOREIGN = (
    # another Python, virtual environment or conda
    "CONDA_PREFIX", "PYTHONHOME", "PYTHONPATH", "VIRTUAL_ENV",
    # another ROS workspace, or the wheels' guard against starting twice
    "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH", "COLCON_PREFIX_PATH", "LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE",
    # the calling make: its flags must not reach the makes below
    "MAKEFLAGS", "MAKELEVEL", "MFLAGS",
    # other installation folders of pip and uv
    "PIP_PREFIX", "PIP_TARGET", "PIP_USER", "UV_PROJECT_ENVIRONMENT", "UV_SYSTEM_PYTHON", "UV_TARGET",
)  # fmt: skip


def clean_environment() -> dict[str, str]:
    """Return the environment for pip and uv: proxies, mirrors and caches stay as the user set them."""
    return {name: value for name, value in os.environ.items() if name not in FOREIGN}


def venv_environment() -> dict[str, str]:
    """Return the environment for building inside the virtual environment, which stands in for /opt/ros/jazzy."""
    return clean_environment() | {
        "PATH": f"{VENV / 'bin'}{os.pathsep}{os.environ.get('PATH', os.defpath)}",
        "AMENT_PREFIX_PATH": str(VENV),
        "CMAKE_PREFIX_PATH": str(VENV),
        "COLCON_DEFAULTS_FILE": os.devnull,
    }


def lock_environment() -> dict[str, str]:
    """Return the environment for resolving versions: no local index, folder of wheels or configuration gets in."""
    kept = ("UV_CACHE_DIR", "UV_HTTP_TIMEOUT")
    return {
        name: value
        for name, value in clean_environment().items()
        if name in kept or not name.startswith(("PIP_", "UV_"))
    }
