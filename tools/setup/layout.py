"""Paths that the set-up reads and writes, and its exception."""

from pathlib import Path

SETUP = Path(__file__).resolve().parent
ROOT = SETUP.parent.parent

MISSING = SETUP / "missing"
"""Packages of ROS 2 that no wheel has. Colcon does not enter the folder unless it is given a package of it."""

REQUIREMENTS = SETUP / "requirements.in"
LOCK = SETUP / "requirements.lock"

OLD_VERSIONS = SETUP / "check_old" / "versions.txt"
OLD_LOCK = SETUP / "check_old" / "requirements.lock"

VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python3"
BUILD = ROOT / "build"
INSTALL = ROOT / "install"
LOG = ROOT / "log"
LOG_FILE = LOG / "setup.log"
STAMP = BUILD / "setup_stamp.json"


class SetupError(Exception):
    """The set-up cannot continue; the message gives the reason and the remedy."""


def tool_pins() -> list[Path]:
    """Return the files with what single tools need besides the environment, pinned; hashes are in ``.txt`` files."""
    return sorted(path for path in ROOT.glob("tools/**/requirements.in") if path != REQUIREMENTS)


def package_folders() -> list[Path]:
    """Return the ROS packages to build: those of the checkout, and those of ROS 2 that the lock has no wheel of."""
    locked = LOCK.read_text(encoding="utf-8")
    missing = [path for path in _packages_in(MISSING) if f"\nros-jazzy-{path.name.replace('_', '-')}==" not in locked]
    return [*_packages_in(ROOT), *missing]


def _packages_in(folder: Path) -> list[Path]:
    """Return the packages right under a folder, by name."""
    return sorted(path.parent for path in folder.glob("*/package.xml"))
