"""What ends the demo early."""

from continuum.errors import ContinuumError


class DemoError(ContinuumError):
    """The demo cannot begin or go on; the message says why, in one line."""
