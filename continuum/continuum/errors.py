"""The one exception family of the library."""

from __future__ import annotations

from continuum.printable import one_line


class ContinuumError(Exception):
    """Base of every error that this library raises on purpose."""


class InvalidValueError(ContinuumError, ValueError):
    """A value that was given from outside is not one that is allowed.

    Args:
        name: what the value is called where it was given, e.g. ``arm.section_1.a``.
        value: the offending value.
        allowed: what would have been right, in words, with its unit.
    """

    def __init__(self, name: str, value: object, allowed: str) -> None:
        self.name = name
        self.value = value
        self.allowed = allowed
        super().__init__(one_line(f"{name} is {value!r}; allowed: {allowed}"))

    def __reduce__(self) -> tuple[type[InvalidValueError], tuple[str, object, str]]:
        """As it is from process to process."""
        return type(self), (self.name, self.value, self.allowed)


class FileError(ContinuumError, OSError):
    """A file is missing, unreadable or not of the expected form."""

    def __init__(self, path: object, problem: str) -> None:
        self.path = path
        self.problem = problem
        super().__init__(one_line(f"{path}: {problem}"))

    def __reduce__(self) -> tuple[type[FileError], tuple[object, str]]:
        """As it is from process to process."""
        return type(self), (self.path, self.problem)


class MeasurementError(ContinuumError):
    """What was measured cannot give what was asked of it, for example a bias while the arm moves."""
