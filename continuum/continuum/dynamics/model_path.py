"""Where a model file is: at its path, or among those that come with the library."""

from __future__ import annotations

from pathlib import Path

SHIPPED = Path(__file__).parent / "models"


def model_path(name: str | Path) -> Path:
    """``name`` itself, or where that is no file the shipped model of that name, if there is one."""
    path = Path(name)
    shipped = SHIPPED / path
    return shipped if shipped.exists() and not path.exists() else path
