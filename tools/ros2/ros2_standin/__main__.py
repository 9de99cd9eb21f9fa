"""``python -m ros2_standin``."""

from __future__ import annotations

import sys

from ros2_standin.cli import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
