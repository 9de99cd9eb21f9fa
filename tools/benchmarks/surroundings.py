"""When and where something is measured."""

from __future__ import annotations

import platform
from datetime import UTC, datetime
from importlib.metadata import version
from pathlib import Path


def today() -> str:
    """The date, as 2026-11-27."""
    return datetime.now(UTC).date().isoformat()


def machine() -> str:
    """Processor and versions of what computes."""
    packages = ", ".join(f"{name} {version(name)}" for name in ("numpy", "scipy", "numba", "casadi", "mujoco"))
    return f"{_processor()}, Python {platform.python_version()}, {packages}"


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.machine()
