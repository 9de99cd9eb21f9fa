"""One-line messages for errors at the start of a node."""

from __future__ import annotations

import re

from rclpy.exceptions import (
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidParameterException,
    InvalidParameterTypeException,
    InvalidTopicNameException,
)
from rclpy.impl.implementation_singleton import rclpy_implementation

from continuum.errors import ContinuumError

START_ERRORS = (
    ContinuumError,
    rclpy_implementation.RCLError,
    rclpy_implementation.UnknownROSArgsError,
    InvalidNamespaceException,
    InvalidNodeNameException,
    InvalidParameterException,
    InvalidParameterTypeException,
    InvalidTopicNameException,
)


def one_line(error: Exception) -> str:
    """Return the error's message without line breaks and without positions in the sources of ROS."""
    text = " ".join(str(error).split())
    if isinstance(error, rclpy_implementation.UnknownROSArgsError):
        text = f"unknown arguments after --ros-args: {text}"
    return re.sub(r",? at \S+\.(c|cpp|hpp|h):\d+", "", text)
