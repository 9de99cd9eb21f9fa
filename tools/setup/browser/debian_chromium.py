"""Debian's Chromium with the libraries that this machine lacks, unpacked to a folder without root permissions."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from tools.setup.browser.place import FOLDER, ROOT, chromium

PACKAGE = "chromium"
PATIENCE = 900.0
"""Longest duration of one step of apt-get [s]."""

STATUS = Path("/var/lib/dpkg/status")
"""Database of the packages installed on the machine."""


class NoChromiumError(Exception):
    """Chromium is not available here; the message gives the reason."""


def fetch() -> None:
    """Download and unpack the packages that the machine lacks.

    Raises:
        NoChromiumError: this is not Debian, there is no network, or the package does not exist.
    """
    if not (shutil.which("apt-get") and shutil.which("dpkg") and STATUS.is_file()):
        raise NoChromiumError("this is no Debian: no apt-get, no dpkg")
    state = FOLDER / "apt"
    for part in ("lists/partial", "archives/partial"):
        (state / part).mkdir(parents=True, exist_ok=True)
    settings = {
        "APT::Sandbox::User": "root",  # only root can change its user; for others this has no effect
        "Debug::NoLocking": "1",
        "Dir::State": str(state),
        "Dir::State::lists": str(state / "lists"),
        "Dir::State::status": str(STATUS),
        "Dir::Cache": str(state),
        "Dir::Cache::archives": str(state / "archives"),
    }
    options = [word for key, value in settings.items() for word in ("-o", f"{key}={value}")]
    print("Chromium for the browser tests, from Debian's packages into out/browser ...", flush=True)
    _run(["apt-get", *options, "update"])
    _run(["apt-get", *options, "install", "--download-only", "--yes", "--no-install-recommends", PACKAGE])
    for package in sorted((state / "archives").glob("*.deb")):
        _run(["dpkg", "-x", str(package), str(ROOT)])
    shutil.rmtree(state)
    if chromium() is None:
        raise NoChromiumError(f"the package {PACKAGE} of this distribution holds no browser")


def _run(command: list[str]) -> None:
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NoChromiumError(str(error)) from error
    if done.returncode:
        words = (done.stderr.strip() or done.stdout.strip() or "failed").splitlines()
        raise NoChromiumError(f"{command[0]}: {words[-1]}")
