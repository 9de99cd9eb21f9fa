"""The sensors' axes live: to which side the arm bends must not hang on when somebody asks."""

from contextlib import suppress
from dataclasses import dataclass

import numpy as np
import pytest
from looped_bench import HELLO

from continuum.arrays import Array
from continuum.errors import MeasurementError
from continuum.inertial.calibration import CalibrationSteps
from continuum_hw_imu.link.received import Received
from continuum_hw_imu.protocol.messages import ImuFrame
from continuum_hw_imu.protocol.messages.imu import PRESENT
from continuum_hw_imu.sensor_watch import KEPT, LOST, SensorWatch

N, RATE = 5, 60
BEND = np.radians(60.0)


@dataclass
class Arm:
    """Sensors without errors on an arm that bends evenly about y; samples come as it moves."""

    watch: SensorWatch
    bend: float = 0.0
    sample: int = 0

    def go(self, bend: float, over: float) -> None:
        """Evenly to a bend of the whole arm [rad] within a time [s]."""
        for target in np.linspace(self.bend, bend, round(over * RATE) + 1)[1:]:
            links = target * np.arange(1, N + 1) / N
            rates = (links - self.bend * np.arange(1, N + 1) / N) * RATE
            self.bend, self.sample = float(target), self.sample + 1
            self._say(rates, links)

    def _say(self, rates: Array, links: Array) -> None:
        order = [sensor.link - 1 for sensor in HELLO.sensors]
        force = 9.81 * np.stack([np.sin(links), np.zeros(N), -np.cos(links)], axis=1)
        frame = ImuFrame.of(self.sample, np.outer(rates, [0, 1, 0])[order], force[order], np.full(N, PRESENT))
        at = self.sample / RATE
        self.watch.take(Received(frame, at, 0.0, at, round(at * 1e6), 1), frame)


@pytest.fixture
def arm() -> Arm:
    """Straight, at rest; bias and zero are found."""
    arm = Arm(SensorWatch(HELLO, CalibrationSteps()))
    arm.go(0.0, 4.0)
    arm.watch.find_bias(3.0)
    arm.watch.find_zero(3.0)
    return arm


def test_the_side_to_which_the_arm_bends_first_is_found(arm):
    arm.go(BEND, 1.0)
    arm.go(0.0, 1.0)
    arm.watch.find_axes()
    np.testing.assert_allclose(arm.watch.steps.axis[:, 1], 1.0, atol=1e-3)


@pytest.mark.parametrize("held", [1.0, KEPT / 2, KEPT - 4.0, KEPT - 2.5, KEPT - 1.5, KEPT + 5.0])
def test_no_motion_that_is_known_from_its_middle_on_turns_the_sign(arm, held):
    """What is kept of it may begin while the arm is bent, and go back first."""
    arm.go(BEND, 1.0)
    arm.go(BEND, held)
    arm.go(0.0, 1.0)
    for _ in range(8):
        with suppress(MeasurementError):
            arm.watch.find_axes()
        axis = arm.watch.steps.axis
        assert axis is None or np.all(axis[:, 1] > 0.99)
        arm.go(0.0, 0.5)


def test_a_zero_from_a_file_does_not_say_when_the_arm_was_straight(arm):
    later = Arm(SensorWatch(HELLO, arm.watch.steps), bend=BEND)
    later.go(0.0, 1.0)
    with pytest.raises(MeasurementError, match="~/zero"):
        later.watch.find_axes()


def test_the_loss_and_the_return_of_a_sensor_are_each_news_once():
    """By the clock of the samples; a gap of all sensors, or a short one, is none."""
    watch, at = SensorWatch(HELLO, CalibrationSteps()), 0

    def take(missing: set[int]) -> list[tuple[int, str, bool, float]]:
        nonlocal at
        at += 1
        flags = np.array([0 if sensor.link in missing else PRESENT for sensor in HELLO.sensors])
        frame = ImuFrame.of(at, np.zeros((N, 3)), np.zeros((N, 3)), flags)
        watch.take(Received(frame, at / RATE, 0.0, at / RATE, round(at / RATE * 1e6), 1), frame)
        news = [(one.link, one.name, one.lost, round(one.gap, 3)) for one in watch.news]
        watch.news.clear()
        return news

    quiet = [set(), {4}, set(), {2}, {2}, set()]
    assert [take(missing) for missing in quiet] == [[]] * len(quiet)
    at += RATE
    assert take(set()) == []
    reported = [news for _ in range(60) if (news := take({2, 5}))]
    (lost,) = reported
    assert [one[:3] for one in lost] == [(2, "S2", True), (5, "S5", True)]
    assert all(LOST < one[3] < LOST + 2 / RATE for one in lost)
    assert take({5}) == [(2, "S2", False, round(61 / RATE, 3))]
    assert take({5}) == []
    assert take(set()) == [(5, "S5", False, round(63 / RATE, 3))]


def test_samples_without_a_sensor_are_counted_by_its_link():
    watch, flags = SensorWatch(HELLO, CalibrationSteps()), np.full(N, PRESENT)
    flags[1] = 0
    frame = ImuFrame.of(1, np.zeros((N, 3)), np.zeros((N, 3)), flags)
    for _ in range(2):
        watch.take(Received(frame, 0.0, 0.0, 0.0, 0, 1), frame)
    lost = np.arange(1, N + 1) == HELLO.sensors[1].link
    np.testing.assert_array_equal(watch.missing, 2 * lost)
    np.testing.assert_array_equal(watch.received, ~lost)
