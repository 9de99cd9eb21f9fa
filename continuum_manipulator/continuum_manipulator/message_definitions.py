"""Text and hash of an installed message type, as stored by rosbag2."""

from __future__ import annotations

import json
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from continuum.errors import FileError

_SEPARATOR = "=" * 80


def message_definition(message_type: str) -> tuple[str, str]:
    """Return the definition and RIHS01 hash of ``message_type``, e.g. ``sensor_msgs/msg/JointState``.

    The definition is the text of the type followed by that of every nested type (rosbag2's ``ros2msg`` encoding).

    Raises:
        FileError: the type is not installed.
    """
    try:
        description = json.loads(_interface_file(message_type, ".json").read_text(encoding="utf-8"))
        texts = [_interface_file(message_type, ".msg").read_text(encoding="utf-8")]
        for inner in description["type_description_msg"]["referenced_type_descriptions"]:
            text = _interface_file(inner["type_name"], ".msg").read_text(encoding="utf-8")
            texts.append(f"MSG: {inner['type_name'].replace('/msg/', '/')}\n{text}")
    except (OSError, PackageNotFoundError, ValueError, LookupError) as error:
        raise FileError(message_type, f"is not an installed message type ({error})") from error
    hashes = {entry["type_name"]: entry["hash_string"] for entry in description["type_hashes"]}
    return f"\n{_SEPARATOR}\n".join(texts), hashes[message_type]


def _interface_file(message_type: str, suffix: str) -> Path:
    package, folder, name = message_type.split("/")
    return Path(get_package_share_directory(package)) / folder / f"{name}{suffix}"
