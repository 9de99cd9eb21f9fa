"""The code on docs/inverse-kinematics.md runs as it stands there."""

import re
from pathlib import Path

import pytest

from continuum.kinematics.ik_result import IkStatus

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "inverse-kinematics.md").read_text(encoding="utf-8")


def test_the_examples_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, object] = {}
    blocks = re.findall(r"```python\n(.+?)```", PAGE, re.DOTALL)
    for block in blocks:
        exec(compile(block, "docs/inverse-kinematics.md", "exec"), names)
    assert len(blocks) == 2
    assert names["answer"].solved
    assert names["many"].solved.tolist() == [True, False]
    assert names["path"].solved.all()
    assert names["published"].solved
    assert not names["motion"].held


def test_every_status_is_explained() -> None:
    assert re.findall(r"^\| `([A-Z_]+)` \|", PAGE, re.MULTILINE) == [status.name for status in IkStatus]
