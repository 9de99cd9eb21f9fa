"""Kinds of the files passed to `continuum view`, and their labels on the page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path


def is_arm(what: str) -> bool:
    """Return whether an argument names an arm: a YAML file, or a bare name that no file here has; not a recording."""
    from continuum.recordings.bag import is_bag

    path = Path(what)
    named = path.suffix in (".yaml", ".yml") or (path.name == what and not path.suffix and not path.exists())
    return named and not is_bag(what)


def labels(paths: Sequence[str]) -> list[str]:
    """Return a distinct label for each path: its name, or the whole path if several have the same name."""
    names = [Path(path).name for path in paths]
    counts = Counter(names)
    distinct = [path if counts[name] > 1 else name for path, name in zip(paths, names, strict=True)]
    seen: Counter[str] = Counter()
    for i, label in enumerate(distinct):
        seen[label] += 1
        if seen[label] > 1:
            distinct[i] = f"{label} ({seen[label]})"
    return distinct
