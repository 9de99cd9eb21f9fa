"""Options of what is known of the sensors: `--angle-wander`, `--wander-time`, `--rate-bias`, `--angle-floor`."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from continuum.errors import InvalidValueError

if TYPE_CHECKING:
    from continuum.identification.noise import SensorKnowledge

_ATTRIBUTES = {
    "--angle-wander": "wander",
    "--wander-time": "wander_time",
    "--rate-bias": "rate_bias",
    "--angle-floor": "angle_floor",
}
"""Of `SensorKnowledge`, by option."""
_SECONDS = ("--wander-time",)  # the others are in degrees


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
    group.add_argument(
        "--angle-floor", metavar="DEG", type=float,
        help="white noise of the angles that is believed at least, however quiet they look; default 0.1",
    )  # fmt: skip


def sensor_knowledge(options: argparse.Namespace) -> SensorKnowledge:
    """What the options say.

    Raises:
        InvalidValueError: a value that is not above 0.
    """
    from continuum.identification.noise import SensorKnowledge

    given = given_sensor_options(options)
    for option, value in given.items():
        if not 0 < value < math.inf:
            raise InvalidValueError(option, value, "a number > 0")
    return SensorKnowledge(
        **{_ATTRIBUTES[name]: value if name in _SECONDS else math.radians(value) for name, value in given.items()}
    )


def given_sensor_options(options: argparse.Namespace) -> dict[str, float]:
    """Those that were given, by the names and in the units in which they were."""
    values = {name: getattr(options, name.removeprefix("--").replace("-", "_"), None) for name in _ATTRIBUTES}
    return {name: value for name, value in values.items() if value is not None}


def unused_sensor_options(options: argparse.Namespace, has_rates: bool) -> list[str]:
    """Those that were given and tell nothing: rates show how angles wander, and where there are none have no bias."""
    unused = "--angle-wander" if has_rates else "--rate-bias"
    return [name for name in given_sensor_options(options) if name == unused]
