"""Where the package's own files are: urdf/, config/, launch/, rviz/."""

from __future__ import annotations

from pathlib import Path

from ament_index_python.packages import get_package_share_directory


def share_directory() -> Path:
    """Folder that holds ``urdf/`` and ``config/``: the source tree when run from it, else the installed share folder.

    Raises:
        ament_index_python.packages.PackageNotFoundError: not run from source and the workspace is not sourced.
    """
    source = Path(__file__).resolve().parents[1]
    if (source / "package.xml").is_file():
        return source
    return Path(get_package_share_directory("continuum_description"))
