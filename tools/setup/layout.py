"""Where the set-up reads and writes, and the one error it raises on purpose."""

from pathlib import Path

SETUP = Path(__file__).resolve().parent
ROOT = SETUP.parent.parent

REQUIREMENTS = SETUP / "requirements.in"
LOCK = SETUP / "requirements.lock"

OLD_VERSIONS = ROOT / "tools" / "check_old" / "versions.txt"
OLD_LOCK = ROOT / "tools" / "check_old" / "requirements.lock"

VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python3"
BUILD = ROOT / "build"
INSTALL = ROOT / "install"
LOG = ROOT / "log"
LOG_FILE = LOG / "setup.log"
STAMP = BUILD / "setup_stamp.json"


class SetupError(Exception):
    """The set-up cannot go on; the text says why and what to do."""


def tool_pins() -> list[Path]:
    """Return the files with what single tools need besides the environment, pinned; hashes are in ``.txt`` files."""
    return sorted(path for path in ROOT.glob("tools/*/requirements.in") if path != REQUIREMENTS)


def package_folders() -> list[Path]:
    """Return the ROS packages of the checkout, by name."""
    return sorted(path.parent for path in ROOT.glob("*/package.xml"))
