"""Signals that end a demo as Ctrl-C does, with everything it started."""

import signal
import sys
from importlib import import_module
from typing import NoReturn


def run_command(module: str) -> NoReturn:
    """Exit with what ``main`` of a module returns, or as Ctrl-C does where a signal interrupts it."""
    try:
        _interrupt_on(signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
        main = import_module(module).main  # slow; an interrupt of it is none of its own
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)


def _interrupt_on(*numbers: signal.Signals) -> None:
    """Let these signals interrupt, unless they are ignored."""
    for number in numbers:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler)
