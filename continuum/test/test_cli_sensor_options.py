"""What is known of the sensors is given in degrees, and reaches the diagnosis in rad."""

import argparse
import math

import numpy as np
import pytest
from identification_laws import releases, small_simulator

import continuum.discovery.answer as asked
from continuum.cli.sensor_options import (
    add_sensor_options,
    given_sensor_options,
    sensor_knowledge,
    unused_sensor_options,
)
from continuum.dynamics.model import Model
from continuum.errors import InvalidValueError
from continuum.identification.dataset import Dataset
from continuum.identification.noise import SensorKnowledge


def options(*words: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    add_sensor_options(parser)
    return parser.parse_args(words)


def parsed(*words: str) -> SensorKnowledge:
    return sensor_knowledge(options(*words))


def test_what_tells_nothing_of_these_recordings_is_named() -> None:
    given = options("--angle-wander", "0.5", "--rate-bias", "0.1", "--wander-time", "2")
    assert unused_sensor_options(given, has_rates=True) == ["--angle-wander"]
    assert unused_sensor_options(given, has_rates=False) == ["--rate-bias"]
    assert unused_sensor_options(options(), has_rates=True) == []
    assert given_sensor_options(given) == {"--angle-wander": 0.5, "--wander-time": 2.0, "--rate-bias": 0.1}


def test_without_options_the_defaults_of_the_library_hold() -> None:
    assert parsed() == SensorKnowledge()


def test_degrees_become_radians_and_seconds_stay() -> None:
    known = parsed("--angle-wander", "0.5", "--wander-time", "3", "--rate-bias", "0.05", "--angle-floor", "0.02")
    assert known == SensorKnowledge(math.radians(0.5), 3.0, math.radians(0.05), math.radians(0.02))


@pytest.mark.parametrize("option", ["--angle-wander", "--wander-time", "--rate-bias", "--angle-floor"])
@pytest.mark.parametrize("value", ["0", "-1", "nan", "inf"])
def test_a_size_that_is_none_is_refused_by_name(option: str, value: str) -> None:
    with pytest.raises(InvalidValueError, match=f"{option} is .*; allowed: a number > 0"):
        parsed(f"{option}={value}")


def test_what_is_known_is_asked_for_every_diagnosis(monkeypatch: pytest.MonkeyPatch) -> None:
    class AskedError(Exception):
        """It was."""

    def diagnosed(_runs: Dataset, _model: Model, known: SensorKnowledge, **_options: object) -> None:
        raise AskedError(known.rate_bias)

    monkeypatch.setattr(asked, "diagnose", diagnosed)
    runs, bias = Dataset(tuple(releases(2, small_simulator(), 0))), float(np.deg2rad(0.3))
    with pytest.raises(AskedError, match=str(bias)):
        asked.answer(runs, small_simulator().model, known=SensorKnowledge(rate_bias=bias))
