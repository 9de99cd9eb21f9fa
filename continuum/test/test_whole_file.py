"""A file is written as a whole, or stays what it was."""

import errno
import os
import stat
import threading
from contextlib import nullcontext
from pathlib import Path

import pytest

from continuum.errors import FileError
from continuum.whole_file import write_whole


def test_a_new_file_takes_the_old_ones_place_and_rights(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_text("old", encoding="utf-8")
    file.chmod(0o640)
    write_whole(file, "n\u00e9w")
    assert file.read_text(encoding="utf-8") == "n\u00e9w"
    assert stat.S_IMODE(file.stat().st_mode) == 0o640
    assert [*tmp_path.iterdir()] == [file]


def test_a_file_that_cannot_be_finished_leaves_the_old_one(tmp_path: Path) -> None:
    file = tmp_path / "a.yaml"
    file.write_text("old", encoding="utf-8")
    with pytest.raises(FileError, match="surrogates"):
        write_whole(file, "begun, and then \ud800")
    assert file.read_text(encoding="utf-8") == "old"
    assert [*tmp_path.iterdir()] == [file]


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to("target")
    write_whole(tmp_path / "link", "text")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "target").read_text(encoding="utf-8") == "text"


def test_a_pipe_is_written_to(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = threading.Thread(target=write_whole, args=(pipe, "text"))
    writer.start()
    assert pipe.read_text(encoding="utf-8") == "text"
    writer.join()


@pytest.mark.parametrize("where", ["no/folder/a.yaml", "."])
def test_what_cannot_be_written_is_named(where: str, tmp_path: Path) -> None:
    with pytest.raises(FileError, match=str(tmp_path / where)):
        write_whole(tmp_path / where, "text")
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize(("number", "taken"), [(errno.EBUSY, True), (errno.ENOSPC, False)])
def test_a_file_mounted_by_itself_is_overwritten(
    number: int, taken: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "a.yaml"
    file.write_text("old", encoding="utf-8")

    def replace(_self: Path, _target: Path) -> None:
        raise OSError(number, "no")

    monkeypatch.setattr(Path, "replace", replace)
    with nullcontext() if taken else pytest.raises(FileError, match="cannot be written"):
        write_whole(file, "new")
    assert file.read_text(encoding="utf-8") == ("new" if taken else "old")
    assert [*tmp_path.iterdir()] == [file]
