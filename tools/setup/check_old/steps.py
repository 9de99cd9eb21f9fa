"""Steps that are tested with the old versions, one command each."""

from __future__ import annotations

from dataclasses import dataclass

_VERSIONS = """python3 -c '
import re, sys
from importlib.metadata import version
from pathlib import Path
pins = re.findall(r"^([a-z0-9-]+)==([^ \\n]+)", Path("tools/setup/check_old/versions.txt").read_text(), re.M)
wrong = [f"{name} is {version(name)}, not {pin}" for name, pin in pins if version(name) != pin]
print(*(f"{name} {pin}" for name, pin in pins), *wrong, sep="\\n")
sys.exit(bool(wrong))
'"""
_MADE = "out/old_versions"


@dataclass(frozen=True)
class Step:
    """One line of the result.

    Attributes:
        title: subject of the step.
        command: bash command that runs in the second checkout.
        codes: exit codes that do not count as a failure.
    """

    title: str
    command: str
    codes: tuple[int, ...] = (0,)


STEPS = (
    Step("versions are those of Ubuntu 24.04", _VERSIONS),
    Step("continuum solve", "continuum solve continuum_description/config/three_sections.yaml 0.15 0 0.20"),
    Step(
        "continuum simulate",
        f"mkdir -p {_MADE} && continuum simulate --release 90 --duration 0.6 --csv {_MADE}/release.csv "
        f"--picture {_MADE}/release.png",
    ),
    Step(
        "continuum diagnose",
        f"continuum diagnose {_MADE}/release.csv --json {_MADE}/verdict.json --report {_MADE}/diagnosis.html",
        codes=(0, 3, 4, 5),  # each is a verdict
    ),
    Step("node robot", "python3 -m pytest -q continuum_manipulator/test/test_robot_node.py"),
    Step("viewer", "python3 -m pytest -q continuum/test/test_viewer_page.py"),
    Step("compiled code, its cache", "python3 -m pytest -q continuum/test/test_compiled_code.py"),
)
