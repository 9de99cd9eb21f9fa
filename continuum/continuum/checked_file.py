"""Files that carry a digest: what was damaged, cut short or written for something else is not read."""

from __future__ import annotations

import hashlib
from pathlib import Path

from continuum.whole_file import write_whole

_DIGEST_SIZE = hashlib.sha256().digest_size  # bytes, at the end of the file: loaders of libraries do not mind them


def read_checked(path: Path, key: str = "") -> bytes | None:
    """The content of a file; None where it is missing, unreadable, damaged or was written with another ``key``."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    content, digest = data[:-_DIGEST_SIZE], data[-_DIGEST_SIZE:]
    return content if digest == _digest(content, key) else None


def write_checked(path: Path, content: bytes, key: str = "") -> None:
    """Write the content and its digest as a whole or not at all; the folder is made if it is missing.

    Raises:
        OSError: it cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, content + _digest(content, key))


def _digest(content: bytes, key: str) -> bytes:
    digest = hashlib.sha256(f"{key}\0".encode())
    digest.update(content)
    return digest.digest()
