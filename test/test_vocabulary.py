"""Names in the code are the field's words: docs/vocabulary.md."""

import io
import re
import tokenize
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BANNED = (
    *("told", "untold", "anew", "afresh", "leader", "leaders", "contender", "contenders", "misfit", "misfits"),
    *("heard", "ears", "deaths", "door", "lookalike", "lookalikes", "felt", "spreads", "promised", "beside"),
    *("looks", "slopes"),
)
"""Words for something that textbooks or ROS have a name for."""


FOLDERS = (
    *("continuum", "continuum_description", "continuum_hw_imu", "continuum_manipulator", "trajectory_generator"),
    *("examples", "test", "tools"),
)


def sources() -> list[Path]:
    return [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.py"))]


def names(path: Path) -> set[str]:
    """Names in a file."""
    tokens = tokenize.generate_tokens(io.StringIO(path.read_text(encoding="utf-8")).readline)
    return {t.string for t in tokens if t.type == tokenize.NAME}


def parts(name: str) -> set[str]:
    return {*re.sub(r"([a-z])([A-Z])", r"\1_\2", name).lower().split("_")}


def test_no_name_has_a_banned_word() -> None:
    found = {(path.name, name) for path in sources() for name in names(path) if parts(name) & {*BANNED}}
    assert found == set()


def test_no_file_is_called_by_one() -> None:
    assert [path for path in sources() if parts(path.stem) & {*BANNED}] == []
