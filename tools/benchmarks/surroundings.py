"""Time and place of a measurement."""

from __future__ import annotations

import platform
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path


def today() -> str:
    """Return the date, for example 2026-11-27."""
    return datetime.now(UTC).date().isoformat()


def machine() -> str:
    """Return the processor and the versions of Python and packages."""
    packages = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "numba", "casadi", "mujoco"))
    return f"{_processor()}, Python {platform.python_version()}, {packages}"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.machine()
