"""``python3 -m tools.demo``."""

import signal
import sys


def interrupt_on(*numbers: signal.Signals) -> None:
    """Let these signals end the demo as Ctrl-C does, with everything it started."""
    for number in numbers:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler)


if __name__ == "__main__":
    try:
        interrupt_on(signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
        from tools.demo.command import main  # slow; an interrupt of it is none of its own

        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
