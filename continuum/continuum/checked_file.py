"""Files with a digest, which detects damaged and truncated files and files written for another purpose."""

from __future__ import annotations

import hashlib
from pathlib import Path

from continuum.whole_file import write_whole

_DIGEST_SIZE = hashlib.sha256().digest_size  # bytes at the end of the file, which loaders of libraries ignore


def read_checked(path: Path, key: str = "") -> bytes | None:
    """Return the content of a file, or None if it is missing, unreadable, damaged or written with another ``key``."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    content, digest = data[:-_DIGEST_SIZE], data[-_DIGEST_SIZE:]
    return content if digest == _digest(content, key) else None


def write_checked(path: Path, content: bytes, key: str = "") -> None:
    """Write the content and its digest atomically; create the folder if it is missing.

    Raises:
        OSError: the file cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, content + _digest(content, key))


def _digest(content: bytes, key: str) -> bytes:
    digest = hashlib.sha256(f"{key}\0".encode())
    digest.update(content)
    return digest.digest()
