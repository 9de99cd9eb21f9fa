"""Optional viewer of a demo; the demo continues if the viewer cannot start."""

from __future__ import annotations

import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from continuum.errors import InvalidValueError
from continuum.viewer.address import HOST, PORT, check_address
from tools.demo.nodes import launched

PATIENCE = 30.0
"""Longest wait for its address [s]."""

_ADDRESS = re.compile(r"open (http://\S+) in a browser")


def port() -> int:
    """Return the viewer's default port if it is free, otherwise 0 for any free port."""
    try:
        check_address(HOST, PORT)
    except InvalidValueError:
        return 0
    return PORT


@contextmanager
def viewed(arm_file: Path, out: Path, domain: int) -> Iterator[None]:
    """Run a viewer on this host during the block, on its default port or a free one, and print its address."""
    log_file = out / "viewer.log"
    command = ["ros2", "run", "continuum_manipulator", "viewer", "--ros-args", "--params-file", str(arm_file.resolve())]
    with (
        log_file.open("w", encoding="utf-8") as log,
        launched([*command, "-p", f"port:={port()}"], domain, log.fileno()) as process,
    ):
        deadline, address = time.monotonic() + PATIENCE, None
        while address is None and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.1)
            address = _ADDRESS.search(log_file.read_text(encoding="utf-8", errors="replace"))
        if address is None:
            print(f"The viewer did not start, see {log_file}; the demo goes on without it.", flush=True)
        else:
            print(f"See it in a browser: {address[1]}", flush=True)
        yield
