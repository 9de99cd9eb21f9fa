"""What a call gives, be it a value or an error of the library; any other error goes on and fails the test."""

from collections.abc import Callable
from typing import Any

from continuum.errors import ContinuumError


def outcome(function: Callable[..., Any], *arguments: object) -> Any:
    """The value that ``function`` returns or the ContinuumError that it raises."""
    try:
        return function(*arguments)
    except ContinuumError as error:
        return error
