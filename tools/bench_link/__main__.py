"""``python3 -m tools.bench_link``."""

import signal
import sys

from tools.bench_link.command import main
from tools.demo.signals import interrupt_on

if __name__ == "__main__":
    try:
        interrupt_on(signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
