"""``ros2 bag info``."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from rosbags.interfaces import Connection
from rosbags.rosbag2 import Reader

from ros2_standin.bag_file import open_bag

_WIDTH = 19
"""Columns of the labels."""

_STORAGE = {".mcap": "mcap", ".db3": "sqlite3"}
_THOUSAND = 1024
_UNITS = ("B", "KiB", "MiB", "GiB", "TiB")


def info_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``info``."""
    parser.add_argument("bag_path", type=Path, help="Bag to open")
    parser.add_argument("-t", "--topic-name", action="store_true", help="Only display topic names")


def info_verb(args: argparse.Namespace) -> None:
    """Print a summary of a recording."""
    with open_bag(args.bag_path) as reader:
        if args.topic_name:
            print("\n".join(sorted(reader.topics)))
        else:
            print(bag_text(args.bag_path, reader))


def bag_text(path: Path, reader: Reader) -> str:
    """Return the summary of an open recording in the format of the stock tool."""
    files = sorted(file for file in (path.iterdir() if path.is_dir() else [path]) if file.suffix in _STORAGE)
    # The reader's interval is half open: one nanosecond more than from the first message to the last.
    duration, end = (reader.duration - 1, reader.end_time - 1) if reader.message_count else (0, 0)
    start = reader.start_time if reader.message_count else 0
    rows = {
        "Files:": [file.name for file in files],
        "Bag size:": [_size(sum(file.stat().st_size for file in files))],
        "Storage id:": sorted({_STORAGE[file.suffix] for file in files}),
        "ROS Distro:": [reader.ros_distro or "unknown"],
        "Duration:": [f"{_seconds(duration)}s"],
        "Start:": [_instant(start)],
        "End:": [_instant(end)],
        "Messages:": [str(reader.message_count)],
        "Topic information:": [_topic(connection) for connection in reader.connections],
    }
    lines = [
        f"{label if i == 0 else '':<{_WIDTH}}{text}" for label, texts in rows.items() for i, text in enumerate(texts)
    ]
    return "\n" + "\n".join(lines) + "\n"


def _topic(connection: Connection) -> str:
    return (
        f"Topic: {connection.topic} | Type: {connection.msgtype} | Count: {connection.msgcount} | "
        f"Serialization Format: {connection.ext.serialization_format}"
    )


def _seconds(nanoseconds: int) -> str:
    return "{}.{:09d}".format(*divmod(nanoseconds, 10**9))


def _instant(nanoseconds: int) -> str:
    seconds, rest = divmod(nanoseconds, 10**9)
    return f"{time.strftime('%b %e %Y %H:%M:%S', time.localtime(seconds))}.{rest:09d} ({_seconds(nanoseconds)})"


def _size(count: int) -> str:
    size, unit = float(count), 0
    while size >= _THOUSAND and unit < len(_UNITS) - 1:
        size, unit = size / _THOUSAND, unit + 1
    return f"{size:.{1 if unit else 0}f} {_UNITS[unit]}"
