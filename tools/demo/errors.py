"""Error that ends the demo early."""

from continuum.errors import ContinuumError


class DemoError(ContinuumError):
    """The demo cannot start or continue; the message gives the reason in one line."""
