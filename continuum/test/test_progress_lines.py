"""What is told of a long diagnosis where standard error is no terminal."""

import pytest

from continuum.cli.progress import told


def test_each_stage_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    with told() as tell:
        for what, part in (("refitting", 0.0), ("effects", 0.1), ("effects", 0.5), ("done", 1.0)):
            tell(what, part)
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.splitlines() == ["continuum: refitting", "continuum: effects", "continuum: done"]
