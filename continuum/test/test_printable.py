"""Names of files as text."""

import os
from pathlib import Path

import numpy as np
import pytest

from continuum.printable import printable
from continuum.recordings.recording_csv import read_recording_csv


@pytest.mark.parametrize("name", ["run 1", "Rückweg", "走行", "a\\b"])
def test_text_stays(name: str) -> None:
    assert printable(name) == name


def test_what_is_no_text_is_reported_in_text() -> None:
    printable(os.fsdecode(b"\xc1rea\xff")).encode()
    assert printable(os.fsdecode(b"\xc1rea")) == r"\xc1rea"


def test_a_recording_has_a_name_that_can_be_written(tmp_path: Path) -> None:
    path = tmp_path / os.fsdecode(b"r\xc1n.csv")
    times = np.arange(100) / 100
    np.savetxt(path, np.column_stack([times, np.sin(times)]), delimiter=",", header="t_s,q1_rad", comments="")
    assert read_recording_csv(path).name == r"r\xc1n"
