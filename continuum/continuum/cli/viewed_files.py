"""What the files are that `continuum view` is given, and what they are called on the page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path


def is_arm(what: str) -> bool:
    """Whether an arm is meant: by a YAML file, or by a bare name that nothing here has; not by a recording."""
    from continuum.recordings.bag import is_bag

    path = Path(what)
    named = path.suffix in (".yaml", ".yml") or (path.name == what and not path.suffix and not path.exists())
    return named and not is_bag(what)


def labels(paths: Sequence[str]) -> list[str]:
    """Return a label for each path, all different: its name, or the whole path where two have the same name."""
    names = [Path(path).name for path in paths]
    counts = Counter(names)
    distinct = [path if counts[name] > 1 else name for path, name in zip(paths, names, strict=True)]
    seen: Counter[str] = Counter()
    for i, label in enumerate(distinct):
        seen[label] += 1
        if seen[label] > 1:
            distinct[i] = f"{label} ({seen[label]})"
    return distinct
