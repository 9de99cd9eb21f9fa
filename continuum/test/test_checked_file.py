"""A file with a digest is read as it was written or not at all."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.checked_file import read_checked, write_checked


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("checked") / "folder" / "file"


@given(content=st.binary(max_size=100), key=st.text(max_size=5), other=st.text(max_size=5))
def test_it_is_read_with_the_key_that_it_was_written_with(file: Path, content: bytes, key: str, other: str) -> None:
    write_checked(file, content, key)
    assert read_checked(file, key) == content
    assert read_checked(file, other) == (content if other == key else None)
    assert [path.name for path in file.parent.iterdir()] == [file.name]


@given(content=st.binary(max_size=100), at=st.integers(0, 131), bit=st.integers(0, 7))
def test_no_bit_is_changed_unseen(file: Path, content: bytes, at: int, bit: int) -> None:
    write_checked(file, content)
    data = bytearray(file.read_bytes())
    data[at % len(data)] ^= 1 << bit
    file.write_bytes(data)
    assert read_checked(file) is None


@given(content=st.binary(max_size=100), length=st.integers(0, 131), more=st.binary(min_size=1, max_size=3))
def test_nothing_is_cut_off_or_added_unseen(file: Path, content: bytes, length: int, more: bytes) -> None:
    write_checked(file, content)
    data = file.read_bytes()
    file.write_bytes(data[: min(length, len(data) - 1)])
    assert read_checked(file) is None
    file.write_bytes(data + more)
    assert read_checked(file) is None


def test_what_is_no_readable_file_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"")
    for path in (tmp_path, tmp_path / "missing", tmp_path / "file" / "below"):
        assert read_checked(path) is None


def test_what_cannot_be_written_leaves_what_was_there(tmp_path: Path) -> None:
    (tmp_path / "taken").mkdir()
    with pytest.raises(OSError, match="taken"):
        write_checked(tmp_path / "taken", b"content")
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]
