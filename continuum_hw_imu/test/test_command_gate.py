"""What a node lets through: within its rate at every opening and after every stall, and as old as it is."""

import numpy as np
import pytest

from continuum.dynamics.live.tension_limit import TensionLimits
from continuum_hw_imu.command_gate import LONGEST, CommandGate

RATE, PATIENCE, SLACK = 100.0, 0.5, 60.0
PULL = np.array([30.0, 0.0])


@pytest.fixture
def gate() -> CommandGate:
    gate = CommandGate(TensionLimits(30.0, RATE, PATIENCE, SLACK), 2)
    assert gate.open()
    gate.move_on(0.0)
    return gate


def test_opened_again_it_begins_at_zero_however_long_it_was_shut(gate):
    gate.shut()
    gate.open()
    gate.command(PULL, 60.0)
    assert gate.move_on(60.004).tolist() == [0.0, 0.0]
    assert gate.move_on(60.014)[0] == pytest.approx(RATE * 0.01)


def test_after_a_stall_tension_goes_on_from_where_it_was(gate):
    gate.command(PULL, 0.0)
    gate.move_on(0.01)
    assert gate.move_on(0.31)[0] == pytest.approx(RATE * (0.01 + LONGEST))


def test_what_falls_since_commands_stopped_is_as_old_as_that(gate):
    gate.command(PULL, 0.0)
    for k in range(1, 100):
        gate.move_on(k / 50)
        assert gate.decided in (0.0, PATIENCE)
    assert gate.abandoned
    assert gate.is_tight
    assert gate.decided == PATIENCE


def test_a_stop_is_ended_by_a_reset_and_another_opening_alone(gate):
    gate.command(PULL, 0.0)
    gate.stop()
    assert not gate.open()
    gate.reset()
    assert not gate.command(PULL, 0.1)
    assert gate.open()
