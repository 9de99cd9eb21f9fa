"""Cable commands: those of a posture within the limits pass, all others are refused by name."""

import numpy as np
import pytest
from arm_messages import ARM
from hypothesis import given
from hypothesis import strategies as st

from continuum.errors import InvalidValueError
from continuum.kinematics.routing import tangle
from continuum_manipulator.command_checks import check_configuration, check_fit, check_lengths, check_rates

NAMES = ARM.cable_names


@given(st.integers(0, 11), st.sampled_from([0.0, -0.1, np.nan]))
def test_length_that_is_none(cable, bad):
    lengths = np.full(12, 0.1)
    check_lengths(lengths, NAMES)
    lengths[cable] = bad
    with pytest.raises(InvalidValueError, match=f"length of {NAMES[cable]} is"):
        check_lengths(lengths, NAMES)


@given(st.integers(0, 11), st.floats(-0.01, 0.01), st.floats(1e-4, 5e-3))
def test_lengths_of_another_posture(cable, off, tolerance):
    found = tangle(np.zeros((3, 2)), ARM)
    lengths = found.copy()
    lengths[cable] += off
    if abs(off) < 0.99 * tolerance:
        check_fit(lengths, found, NAMES, tolerance)
    elif abs(off) > 1.01 * tolerance:
        with pytest.raises(InvalidValueError, match=f"length of {NAMES[cable]} is"):
            check_fit(lengths, found, NAMES, tolerance)


@pytest.mark.parametrize("number", range(3))
def test_bend_beyond_the_limit(number):
    section = ARM.sections[number]
    w = np.zeros((3, 2))
    w[number] = [0.0, section.bend_limit]
    check_configuration(w, ARM.sections)
    w[number, 1] += 1e-3
    with pytest.raises(InvalidValueError, match=f"bend of {section.name} is"):
        check_configuration(w, ARM.sections)
    with pytest.raises(InvalidValueError, match=f"bend of {section.name} is"):
        check_configuration(w[number], [section])


def test_rates_that_are_none():
    check_rates(np.zeros((3, 2)))
    with pytest.raises(InvalidValueError, match="rate of the configuration"):
        check_rates(np.array([0.0, np.nan]))
