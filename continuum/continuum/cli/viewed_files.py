"""Kinds of the files passed to `continuum view`, and their labels on the page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from continuum.arm import Arm, load_arm
from continuum.errors import FileError, InvalidValueError
from continuum.joint_names import bending_joints


def is_arm(what: str) -> bool:
    """Return whether an argument names an arm: a YAML file, or a bare name that no file here has; not a recording."""
    from continuum.recordings.bag import is_bag

    path = Path(what)
    named = path.suffix in (".yaml", ".yml") or (path.name == what and not path.suffix and not path.exists())
    return named and not is_bag(what)


def check_kinds(what: Sequence[str]) -> None:
    """Refuse arms among recordings.

    Raises:
        InvalidValueError: some of the arguments name arms, others recordings.
    """
    arms = [one for one in what if is_arm(one)]
    if arms and len(arms) < len(what):
        allowed = "recordings that exist; --arm takes the arm of a recording, and --model a model of it"
        raise InvalidValueError("ARM.yaml|RECORDING", ", ".join(arms), allowed)


def load_viewed_arm(name: str) -> Arm:
    """Read the arm that an argument names.

    Raises:
        FileError: there is no such arm; the argument may also be a mistyped recording.
        InvalidValueError: the arm is not valid.
    """
    try:
        return load_arm(name)
    except FileError as error:
        if Path(name).suffix or Path(name).exists():
            raise
        raise FileError(name, f"no recording has this name; as an arm file it {error.problem}") from None


def check_same_joints(path: str, names: Sequence[str], first: str, expected: Sequence[str]) -> None:
    """Refuse a recording with other sections or numbers of joints than the first recording.

    Raises:
        FileError: the recording is of another arm.
    """
    here, there = bending_joints(names), bending_joints(expected)
    if here != there:
        raise FileError(path, f"has joints {_counts(here)}; the first recording, {first}, has {_counts(there)}")


def _counts(joints: Mapping[str, int]) -> str:
    return ", ".join(f"{name}: {n}" for name, n in sorted(joints.items())) or "of no section"


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
