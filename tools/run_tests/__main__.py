"""`make test`: first the tests that start nodes, one after the other, then those of the library on up to four cores.

A node that starts beside tests that compute waits for a core, on a busy machine for a minute; then tests fail that say
what happens within seconds.
"""

from __future__ import annotations

import subprocess
import sys
from enum import IntEnum
from typing import Final

PARTS: Final = (
    ("--library=left-out",),
    ("--library=only", "--numprocesses=auto", "--maxprocesses=4", "--dist=loadfile"),
)
"""What pytest is told for each part; ``--library`` is an option of ``conftest.py``."""


class Code(IntEnum):
    """Exit codes of pytest that are no failure."""

    PASSED = 0
    INTERRUPTED = 2
    NOTHING_TO_RUN = 5


def main(arguments: list[str] | None = None) -> int:
    """Run both parts, the second also where the first fails; give pytest's exit code of the first that failed."""
    given = sys.argv[1:] if arguments is None else arguments
    codes: list[int] = []
    for part in PARTS:
        codes.append(subprocess.run([sys.executable, "-m", "pytest", *part, *given], check=False).returncode)
        if codes[-1] == Code.INTERRUPTED:
            break
    return exit_code(codes)


def exit_code(codes: list[int]) -> int:
    """Exit code of the whole: a part without tests is no failure unless no part has any."""
    ran = [code for code in codes if code != Code.NOTHING_TO_RUN]
    return next(filter(None, ran), Code.PASSED) if ran else Code.NOTHING_TO_RUN


if __name__ == "__main__":
    sys.exit(main())
