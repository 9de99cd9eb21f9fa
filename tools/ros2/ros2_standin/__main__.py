"""``python -m ros2_standin``."""

from __future__ import annotations

import sys

try:
    from ros2_standin.cli import main
except KeyboardInterrupt:
    sys.exit(130)

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
