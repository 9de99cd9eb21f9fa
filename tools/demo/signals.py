"""Let signals end a demo with all its processes, as Ctrl-C does."""

import signal
import sys
from importlib import import_module
from typing import NoReturn


def run_command(module: str) -> NoReturn:
    """Exit with the result of a module's ``main``, or as after Ctrl-C if a signal interrupts it."""
    try:
        _interrupt_on(signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
        main = import_module(module).main  # slow; a signal may interrupt the import
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)


def _interrupt_on(*numbers: signal.Signals) -> None:
    """Let these signals raise an interrupt, unless they are ignored."""
    for number in numbers:
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, signal.default_int_handler)
