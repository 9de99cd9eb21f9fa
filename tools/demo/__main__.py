"""``python3 -m tools.demo``."""

import signal
import sys

from tools.demo.signals import interrupt_on

if __name__ == "__main__":
    try:
        interrupt_on(signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
        from tools.demo.command import main  # slow; an interrupt of it is none of its own

        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
