"""What a command is asked to write is none of what it reads, by whatever name, and can be written."""

import subprocess
from pathlib import Path

import pytest
from command_line import THREE, Captured, code
from full_disk import at_most

from continuum.errors import FileError
from continuum.output_files import check_apart, check_writable

RELEASE = ("simulate", "--release", "30", "--duration", "1")


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A folder with what is read: a table, and a recording."""
    (tmp_path / "run").mkdir()
    for name in ("in.csv", "run/run.mcap"):
        (tmp_path / name).write_text("data", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("read", ["in.csv", "run/run.mcap", "run"])
@pytest.mark.parametrize("link", ["hard", "symbolic", "none"])
def test_what_is_read_is_not_written(data: Path, read: str, link: str) -> None:
    file = data / "run/run.mcap" if read == "run" else data / read
    out = file if link == "none" else data / "out.csv"
    if link == "hard":
        out.hardlink_to(file)
    elif link == "symbolic":
        out.symlink_to(file)
    with pytest.raises(FileError, match="is read, and would be overwritten"):
        check_apart([out], [data / read])
    check_apart([data / "other.csv"], [data / read])


def test_two_outputs_are_two_files(data: Path) -> None:
    (data / "a").hardlink_to(data / "in.csv")
    (data / "to").symlink_to("not there yet")
    for one, other in (("in.csv", "a"), ("to", "not there yet"), ("b", "b")):
        with pytest.raises(FileError, match="written twice"):
            check_apart([data / one, data / other], [])
    check_apart([data / "b", data / "c"], [])


def test_the_check_of_a_dangling_link_changes_nothing(tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to("target")
    check_writable(tmp_path / "link")
    assert [path.name for path in tmp_path.iterdir()] == ["link"]
    assert (tmp_path / "link").is_symlink()
    (tmp_path / "link").unlink()
    (tmp_path / "link").symlink_to("no/target")
    with pytest.raises(FileError, match="link"):
        check_writable(tmp_path / "link")
    assert (tmp_path / "link").is_symlink()


@pytest.mark.parametrize("option", ["--csv", "--picture"])
def test_a_command_on_a_full_disk_leaves_the_old_file(capsys: Captured, tmp_path: Path, option: str) -> None:
    out = tmp_path / "out.png"
    out.write_text("old", encoding="utf-8")
    code(*RELEASE, option, tmp_path / "first.png")  # what has to be compiled is compiled
    capsys.readouterr()
    with at_most(4096):
        assert code(*RELEASE, option, out) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"continuum: {out}: cannot be written (")
    assert out.read_text(encoding="utf-8") == "old"
    assert {path.name for path in tmp_path.iterdir()} == {"first.png", "out.png"}


def test_what_cannot_be_printed_is_one_line() -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        command = ["continuum", "info", THREE]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 2
    (line,) = done.stderr.splitlines()
    assert line.startswith("continuum: what is printed cannot be written")
