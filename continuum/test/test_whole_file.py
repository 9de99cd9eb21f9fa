"""A file is written as a whole, or stays what it was."""

import csv
import errno
import os
import stat
import threading
from contextlib import nullcontext
from pathlib import Path

import pytest
from full_disk import at_most
from matplotlib.figure import Figure

from continuum.errors import FileError
from continuum.whole_file import write_figure, write_table, write_whole


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


@pytest.mark.parametrize("target", ["no/target", "link"])
def test_a_link_to_nowhere_or_to_itself_is_refused_and_stays(tmp_path: Path, target: str) -> None:
    (tmp_path / "link").symlink_to(target)
    with pytest.raises(FileError, match="link"):
        write_whole(tmp_path / "link", "text")
    assert [*tmp_path.iterdir()] == [tmp_path / "link"]
    assert (tmp_path / "link").is_symlink()


@pytest.mark.parametrize("before", ["old", None])
def test_a_full_disk_leaves_what_was_there(before: str | None, tmp_path: Path) -> None:
    file = tmp_path / "a.csv"
    if before is not None:
        file.write_text(before, encoding="utf-8")
    with at_most(4096), pytest.raises(FileError, match="cannot be written"):
        write_whole(file, 10_000 * "a")
    assert [one.read_text(encoding="utf-8") for one in tmp_path.iterdir()] == [before] * (before is not None)


def test_a_name_as_long_as_may_be_is_written(tmp_path: Path) -> None:
    write_whole(tmp_path / (255 * "a"), "text")
    assert (tmp_path / (255 * "a")).read_text(encoding="utf-8") == "text"


def test_a_table_is_read_back_as_it_was(tmp_path: Path) -> None:
    rows = [["t_s", "a, b"], ["0.5", 'so "it" is\r\n']]
    write_table(tmp_path / "a.csv", rows)
    with (tmp_path / "a.csv").open(newline="", encoding="utf-8") as file:
        assert [*csv.reader(file)] == rows


@pytest.mark.parametrize(("name", "begin"), [("a.png", b"\x89PNG"), ("a.PDF", b"%PDF"), ("a", b"\x89PNG")])
def test_a_picture_has_the_format_of_its_name(name: str, begin: bytes, tmp_path: Path) -> None:
    write_figure(tmp_path / name, Figure(), dpi=10)
    assert (tmp_path / name).read_bytes().startswith(begin)


def test_a_picture_of_no_known_format_is_refused(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be drawn"):
        write_figure(tmp_path / "a.xyz", Figure(), dpi=10)
    assert [*tmp_path.iterdir()] == []


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


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_names_that_the_font_cannot_draw_are_no_warning(tmp_path: Path, kind: str) -> None:
    """Warnings are errors in these tests."""
    figure = Figure(layout="constrained")
    figure.subplots().set_title("測定_1, ação")
    write_figure(tmp_path / f"a.{kind}", figure, dpi=50)
    assert (tmp_path / f"a.{kind}").stat().st_size > 0
