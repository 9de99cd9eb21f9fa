"""Signals that end a demo as Ctrl-C does, with everything it started."""

import signal


def interrupt_on(*numbers: signal.Signals) -> None:
    """Let these signals interrupt, unless they are ignored."""
    for number in numbers:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler)
