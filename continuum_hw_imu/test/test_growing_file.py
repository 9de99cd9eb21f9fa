"""A file that grows is read on the way, and a full disk is one line."""

from pathlib import Path

import pytest
from full_disk import at_most

from continuum.errors import FileError
from continuum_hw_imu.emulator.growing_file import GrowingFile


def test_every_line_can_be_read_at_once(tmp_path: Path) -> None:
    file = GrowingFile(tmp_path / "a.csv")
    for count in range(1, 4):
        file.write("1,2\r\n")
        assert (tmp_path / "a.csv").read_bytes() == count * b"1,2\r\n"
    file.close()


def test_a_full_disk_is_reported_with_the_files_name(tmp_path: Path) -> None:
    file = GrowingFile(tmp_path / "a.csv")
    with at_most(4096):
        with pytest.raises(FileError, match=r"a\.csv: cannot be written"):
            file.write(4096 * "1,2\n")
        file.close()


def test_what_cannot_be_opened_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be written"):
        GrowingFile(tmp_path / "no" / "a.csv")
