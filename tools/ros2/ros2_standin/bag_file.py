"""Open recordings (rosbag2 folders, MCAP or SQLite) by ``rosbags``, with one-line errors."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rosbags.rosbag2 import Reader, ReaderError

from ros2_standin.errors import UserError


@contextmanager
def open_bag(path: Path) -> Iterator[Reader]:
    """Open a recording.

    Args:
        path: the rosbag2 folder, or one storage file of it.

    Raises:
        UserError: the recording does not exist or cannot be read.
    """
    try:
        with Reader(path) as reader:
            yield reader
    except FileNotFoundError as error:
        raise UserError(f"[ERROR] [ros2bag]: bag path '{path}': {error}") from error
    except (ReaderError, OSError) as error:
        raise UserError(f"[ERROR] [ros2bag]: '{path}' cannot be read: {error}") from error
