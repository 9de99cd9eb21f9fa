"""What may be wrong with the way a node was started, said in one line."""

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
    """The error's message without line breaks and without the places in ROS's own sources."""
    text = " ".join(str(error).split())
    if isinstance(error, rclpy_implementation.UnknownROSArgsError):
        text = f"unknown arguments after --ros-args: {text}"
    return re.sub(r",? at \S+\.(c|cpp|hpp|h):\d+", "", text)
