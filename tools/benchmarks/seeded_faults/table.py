"""The list of faults, `faults.toml`: by file, the original text, its faulty replacement, and the tests to find it."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Fault:
    """One fault: ``text``, which occurs once in the file ``path``, becomes ``instead``; the nearest test is first."""

    path: str
    text: str
    instead: str
    tests: tuple[str, ...]

    @property
    def package(self) -> str:
        """Package of the file, or its folder in the library or the tools."""
        parts = Path(self.path).parts[:-1]
        return "/".join(parts[1:3] if parts[:1] == ("continuum",) else parts[: 2 if parts[:1] == ("tools",) else 1])

    def problem(self, root: Path) -> str:
        """Return why the entry is invalid; empty if it is valid."""
        missing = [name for name in (self.path, *self.tests) if not (root / name).exists()]
        if missing:
            return f"there is no {', '.join(missing)}"
        count = (root / self.path).read_text(encoding="utf-8").count(self.text)
        return "" if count == 1 else f"its text stands {count} times in the file, not once"

    def __str__(self) -> str:
        return f"{self.path}: {' '.join(self.text.split())}  ->  {' '.join(self.instead.split()) or 'nothing'}"


def read_faults(table: Path) -> list[Fault]:
    """Read all faults of the table."""
    files = tomllib.loads(table.read_text(encoding="utf-8"))["file"]
    return [Fault(one["path"], *pair, tests=tuple(one["tests"])) for one in files for pair in one["faults"]]
