"""Options of what is known of the sensors: `--angle-wander`, `--wander-time`, `--rate-bias`."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from continuum.errors import InvalidValueError

if TYPE_CHECKING:
    from continuum.identification.noise import SensorKnowledge

_DEGREES = ("angle_wander", "rate_bias")  # the other option is in s


def add_sensor_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a command; each without a default, which `SensorKnowledge` has."""
    group = parser.add_argument_group("sensors", "what is known of them beforehand; white noise is read off the data")
    group.add_argument(
        "--angle-wander", metavar="DEG", type=float,
        help="standard deviation of the angles' slow error, where no rates tell it; default 0.2",
    )  # fmt: skip
    group.add_argument("--wander-time", metavar="S", type=float, help="how long that error stays alike; default 1")
    group.add_argument(
        "--rate-bias", metavar="DEG_S", type=float,
        help="standard deviation of the rates' constant error, once calibrated; default 0.15",
    )  # fmt: skip


def sensor_knowledge(options: argparse.Namespace) -> SensorKnowledge:
    """What the options say.

    Raises:
        InvalidValueError: a value that is not above 0.
    """
    from continuum.identification.noise import SensorKnowledge

    given = {name: getattr(options, name) for name in ("angle_wander", "wander_time", "rate_bias")}
    for name, value in given.items():
        if value is not None and not 0 < value < math.inf:
            raise InvalidValueError(f"--{name.replace('_', '-')}", value, "a number > 0")
    named = {
        name.removeprefix("angle_"): math.radians(value) if name in _DEGREES else value
        for name, value in given.items()
        if value is not None
    }
    return SensorKnowledge(**named)
