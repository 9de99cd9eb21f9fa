"""The exceptions of the library."""

from __future__ import annotations

from continuum.printable import one_line


class ContinuumError(Exception):
    """Base class of all errors that this library raises deliberately."""


class InvalidValueError(ContinuumError, ValueError):
    """A value from the user or a file is not allowed.

    Args:
        name: name of the value in its source, e.g. ``arm.section_1.a``.
        value: the offending value.
        allowed: the allowed values in words, with their unit.
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
    """A file is missing, unreadable or malformed."""

    def __init__(self, path: object, problem: str) -> None:
        self.path = path
        self.problem = problem
        super().__init__(one_line(f"{path}: {problem}"))

    def __reduce__(self) -> tuple[type[FileError], tuple[object, str]]:
        """As it is from process to process."""
        return type(self), (self.path, self.problem)


class MeasurementError(ContinuumError):
    """The measurement does not contain the requested quantity, for example a bias while the arm moves."""
