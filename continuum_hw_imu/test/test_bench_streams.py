"""What is published of frames, and what is not: nothing wrong, nothing of another bench, nothing not measured."""

import time
from dataclasses import replace

import numpy as np
import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from looped_bench import HELLO, LoopedBench
from rclpy.clock import Clock

from continuum.dynamics.live.tension_limit import TensionLimits
from continuum.dynamics.model_file import load_model
from continuum.inertial.calibration import CalibrationSteps
from continuum.inertial.calibration_values import Calibration
from continuum_hw_imu.bench_commander import BenchCommander
from continuum_hw_imu.bench_diagnostics import BenchDiagnostics
from continuum_hw_imu.bench_streams import BenchStreams
from continuum_hw_imu.imu_messages import ImuMessages
from continuum_hw_imu.protocol.messages import ImuFrame, SensorPlace, TensionFrame
from continuum_hw_imu.protocol.messages.imu import CLIPPED_RATE, PRESENT
from continuum_hw_imu.sensor_quality import SensorQuality
from continuum_manipulator.nodekit.planar_arm import PlanarArm
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds

N = 5
UP = np.tile([0.0, 0.0, 9.81], (N, 1))
KNOWN = CalibrationSteps.of(Calibration(np.zeros((N, 3)), np.tile([0.0, 1.0, 0.0], (N, 1)), UP, ("by hand",) * N))


class Published:
    """A bench in a loop, and all that is published of it. Links count from 1 here, as everywhere."""

    def __init__(self, steps=KNOWN, hello=HELLO) -> None:
        self.joints, self.cables, self.imus = [], [], [[] for _ in range(N)]
        self.streams = BenchStreams(
            PlanarArm("section_1", load_model("lamecc_prototype.yaml")),
            [ImuMessages(f"section_1_imu_{k}", SensorQuality()) for k in range(1, N + 1)],
            Clock(),
            steps,
            self.joints.append,
            self.cables.append,
            [imu.append for imu in self.imus],
        )
        self.bench = LoopedBench(hello)
        self.bench.client._hand_on = self.streams.take
        self.bench.connect()
        self.streams.publishing = True
        self._sample = 0
        commander = BenchCommander(TensionLimits(12.0, 100.0, 0.4, 0.2), 2, lambda: self.bench.now)
        commander.client = self.bench.client
        self._diagnostics = BenchDiagnostics("bridge", self.streams, commander, "nowhere", N)

    def measure(self, frames: int = 1, rates=None, flags=None, link_rates=None, forces=UP, answers=True) -> None:
        """Samples at 60 Hz; rates (n, 3) [rad/s] in the order of the frame, or about y of each link (n,).

        Specific forces (n, 3) [m/s2] are in the order of the frame, too. With ``answers``, the bench answers a request
        before each sample, from which the error of stamps is known.
        """
        rates = np.zeros((N, 3)) if rates is None else rates
        if link_rates is not None:
            links = [sensor.link - 1 for sensor in HELLO.sensors]
            rates = np.outer(np.asarray(link_rates)[links], [0.0, 1.0, 0.0])
        flags = np.full(N, PRESENT) if flags is None else flags
        for _ in range(frames):
            self.bench.now += 1 / 60
            self._sample += 1
            if answers:
                self.bench.client.beat()
            self.bench.say(ImuFrame.of(self._sample, rates, forces, flags))

    def status(self, subject: str) -> DiagnosticStatus:
        """What is told on `/diagnostics` of a subject now."""
        statuses = (tell() for tell in self._diagnostics.subjects())
        return next(status for status in statuses if status.name == f"bridge: {subject}")


def test_nothing_is_known_before_a_rest_and_then_everything_is():
    published = Published()
    published.measure(5)
    assert not published.joints
    assert published.streams.withheld == 5
    assert published.streams.lost_for == np.inf
    published.measure(60)
    assert published.joints
    assert published.streams.lost_for == 0.0
    np.testing.assert_allclose(published.joints[-1].position, np.zeros(N + 2), atol=1e-6)
    assert [len(imu) for imu in published.imus] == [65] * N


def test_sensors_are_reported_apart_by_their_links():
    """Frames have them in the bench's order, here 3, 1, 5, 2, 4; the arm turns at joint 4 alone."""
    published = Published()
    published.measure(60)
    published.measure(3, link_rates=[0.0, 0.0, 0.0, 0.5, 0.5])
    np.testing.assert_allclose(published.joints[-1].velocity, [0, 0, 0, 0, 0.5, 0, 0], atol=1e-2)
    assert published.joints[-1].position[4] == pytest.approx(0.5 * 3 / 60, abs=2e-3)
    assert [imu[-1].angular_velocity.y for imu in published.imus] == pytest.approx([0, 0, 0, 0.5, 0.5], abs=1e-3)


def test_frames_of_other_sensors_or_cables_are_left_out_and_counted():
    published = Published()
    published.measure(5)
    published.bench.say(ImuFrame.of(6, np.zeros((3, 3)), UP[:3], np.full(3, PRESENT)))
    published.bench.say(TensionFrame((1.0,), (None,)))
    assert published.streams.unfit == 2
    assert not published.cables
    assert [len(imu) for imu in published.imus] == [5] * N


@pytest.mark.parametrize("limit", ["slack_time", "command_timeout", "heartbeat_timeout"])
def test_a_bench_that_pulls_on_for_long_or_lets_cables_go_for_ever_is_none(limit):
    stubborn = replace(HELLO, limits=replace(HELLO.limits, **{limit: 60.0}))
    assert "60 s" in Published(hello=stubborn).streams.problem


def test_a_bench_that_reports_other_places_is_greeted_again_whatever_its_boot():
    """As firmware that names the sensors that it hears just now, or always the same number."""
    published = Published()
    published.measure(60)
    published.joints.clear()
    published.bench.say(replace(HELLO, sensors=HELLO.sensors[1:]))
    assert "has sensors on the links 1, 2, 4, 5" in published.streams.problem
    published.bench.say(replace(HELLO, sensors=tuple(reversed(HELLO.sensors))))
    assert not published.streams.problem
    published.measure(5)
    assert not published.joints  # the arm has to rest anew, and readings are of other links now


def test_a_missing_sensor_withholds_joint_states_and_its_own_data_alone():
    published = Published()
    published.measure(60)
    before = len(published.joints), [len(imu) for imu in published.imus]
    flags = np.full(N, PRESENT)
    flags[2] = 0  # the third in the frame is on link 5
    published.measure(1, flags=flags)
    assert len(published.joints) == before[0]
    assert [len(imu) - n for imu, n in zip(published.imus, before[1], strict=True)] == [1, 1, 1, 1, 0]


@pytest.mark.parametrize("trouble", ["missing", "clipped"])
def test_no_joint_state_is_wrong_while_a_sensor_turns_unmeasured(trouble):
    """Link 5 turns by 1 rad unseen, or faster than its sensor's range: only rest tells by how much."""
    published, at = Published(), 2  # the third in the frame is on link 5
    published.measure(60)
    before = len(published.joints)
    flags, forces, turn = np.full(N, PRESENT), UP.copy(), 1.0
    flags[at] = 0 if trouble == "missing" else PRESENT | CLIPPED_RATE[1]
    published.measure(30, flags=flags, link_rates=[0.0, 0.0, 0.0, 0.0, 0.7])
    assert len(published.joints) == before
    complaint, output = published.status("angles"), published.status("imu 5")
    assert complaint.level == DiagnosticStatus.ERROR
    assert f"sensor 5 is {trouble}" in complaint.message
    assert f"30 samples {trouble}" in output.message
    assert (output.level == DiagnosticStatus.ERROR) == ("no data" in output.message) == (trouble == "missing")
    assert published.status("imu 4").level != DiagnosticStatus.ERROR
    forces[at] = 9.81 * np.array([-np.sin(turn), 0.0, np.cos(turn)])
    published.measure(120, forces=forces)
    assert len(published.joints) > before
    for joints in published.joints[before:]:
        np.testing.assert_allclose(joints.position[1:-1], [0.0, 0.0, 0.0, 0.0, turn], atol=0.01)
    assert published.status("angles").level != DiagnosticStatus.ERROR


def test_angles_whose_time_is_not_known_are_withheld():
    """No answer limits by how much all frames so far were late."""
    published = Published()
    published.measure(60, answers=False)
    assert not published.joints
    assert published.status("angles").level == DiagnosticStatus.ERROR
    assert "the time of the sample is not known" in published.status("angles").message
    published.bench.say(TensionFrame((1.0, 0.0), (1.02, 0.0)))
    assert not any((published.cables, *published.imus))
    published.measure(1)
    published.bench.say(TensionFrame((1.0, 0.0), (1.02, 0.0)))
    assert len(published.joints) == len(published.cables) == 1
    assert [len(imu) for imu in published.imus] == [1] * N


@pytest.mark.parametrize(("late", "speed", "known"), [(0.008, 0.1, True), (0.008, 3.5, False), (0.02, 0.0, False)])
def test_angles_are_withheld_where_the_error_of_their_time_makes_them_wrong(late, speed, known):
    """Here link 1 turns so fast [rad/s], and all frames come later than they could by so much [s].

    Raw data and cable states are withheld where even the angles of an arm at rest are.
    """
    published = Published()
    published.measure(60, answers=False)
    bench = published.bench
    bench.client._now = lambda: bench.now - late  # of each request, which the bench answers when it hears it
    published.measure(1)
    for seen in (published.joints, *published.imus):
        seen.clear()
    published.measure(3, link_rates=[speed] * N)
    bench.say(TensionFrame((1.0, 0.0), (1.02, 0.0)))
    assert bool(published.joints) is known
    assert bool(published.cables) is bool(published.imus[0]) is (late < 0.015)


def test_nothing_is_published_while_the_node_is_not_active():
    published = Published()
    published.streams.publishing = False
    published.measure(60)
    published.bench.say(TensionFrame((1.0, 0.0), (1.02, 0.0)))
    assert not any((published.joints, published.cables, *published.imus))
    assert published.streams.withheld == 0
    published.streams.publishing = True
    published.measure(1)
    assert len(published.joints) == 1


def test_the_time_of_lost_angles_is_counted_by_the_clock_of_the_bench():
    published = Published()
    published.measure(60)
    assert published.streams.lost_for == 0.0
    flags = np.full(N, PRESENT)
    flags[2] = 0
    published.measure(30, flags=flags)
    assert published.streams.lost_for == pytest.approx(0.5, abs=1e-3)
    published.measure(60)
    assert published.streams.lost_for == 0.0


@pytest.mark.parametrize("unfit", [False, True])
def test_angles_are_lost_when_no_frames_of_the_sensors_come(unfit):
    """But others do: the task of the sensors hangs, or it reports another number of them."""
    published = Published()
    published.measure(60)
    bench, streams = published.bench, published.streams
    for _ in range(10):
        bench.pass_time(0.1)
        bench.say(bench.controller.status())
        if unfit:
            bench.say(ImuFrame.of(6, np.zeros((3, 3)), UP[:3], np.full(3, PRESENT)))
    assert streams.lost_for == pytest.approx(1.0, abs=1e-3)
    assert streams.silent
    assert published.status("angles").level == DiagnosticStatus.ERROR
    assert "no frames of the sensors" in published.status("angles").message
    bench.say(TensionFrame((1.0, 0.0), (1.02, -0.03)))
    assert not published.cables[-1].position
    published.measure(120)
    assert not streams.silent
    assert streams.lost_for == 0.0
    assert not streams.doubt


def test_what_is_clipped_has_the_covariance_of_anything_in_range():
    published = Published()
    flags = np.full(N, PRESENT)
    flags[1] |= CLIPPED_RATE[0]  # on link 1
    published.measure(1, flags=flags)
    clipped, sure = (imu[-1].angular_velocity_covariance[0] for imu in published.imus[:2])
    assert clipped == pytest.approx(SensorQuality().rate_range ** 2)
    assert sure == pytest.approx(SensorQuality().rate_noise ** 2)


def test_without_calibration_there_are_raw_data_and_no_joint_states():
    published = Published(CalibrationSteps())
    published.measure(90)
    assert not published.joints
    assert len(published.imus[0]) == 90
    with pytest.raises(Exception, match="without the bias"):
        published.streams.watch.find_axes()
    published.streams.watch.find_bias(1.2)
    assert published.streams.watch.steps.missing == ("zero", "axis")


def test_measured_tensions_are_reported_with_lengths_that_are_known():
    published = Published()
    published.bench.client.beat()  # from the answer, the error of stamps is known
    published.bench.say(TensionFrame((1.0, 0.0), (1.02, -0.03)))
    assert published.cables[-1].effort.tolist() == [1.02, 0.0]  # a cable never pushes
    assert not published.cables[-1].position
    published.measure(60)
    published.bench.say(TensionFrame((1.0, 0.0), (1.02, None)))
    assert not published.cables[-1].effort
    assert len(published.cables[-1].position) == 2


def test_another_bench_is_not_taken_for_the_arm():
    other = replace(HELLO, sensors=tuple(SensorPlace(k, "S") for k in (1, 2, 3)))
    published = Published(hello=other)
    published.bench.say(ImuFrame.of(1, np.zeros((3, 3)), UP[:3], np.full(3, PRESENT)))
    assert published.streams.problem == (
        "looped has sensors on the links 1, 2, 3; the model has 5 joints, a sensor on each"
    )
    assert published.streams.watch is None
    cables = Published(hello=replace(HELLO, n_cables=4))
    assert "has 4 cables" in cables.streams.problem


def test_a_bench_that_begins_again_has_to_rest_again():
    published = Published()
    published.measure(60)
    assert published.joints
    published.bench.say(replace(HELLO, boot=HELLO.boot + 1))
    published.joints.clear()
    published.measure(5)
    assert not published.joints
    assert published.streams.lost_for == np.inf
    published.measure(60)
    assert published.joints


def test_a_bench_that_begins_again_unheard_is_asked_who_it_is_and_no_old_angle_is_reported():
    """Its greeting was lost: the clock that went back tells. Raw data wait for the greeting, too."""
    published = Published()
    published.measure(60)
    bench, first = published.bench, published.bench.client.conversations
    for seen in (published.joints, *published.imus):
        seen.clear()
    bench.now -= 8.0
    published.measure(5, link_rates=[0.5] * N)
    assert bench.client.hello is None
    assert bench.client.conversations == first + 1
    assert not any((published.joints, *published.imus))
    bench.client.ask_who(1e9)
    assert bench.client.hello == HELLO
    published.measure(5)
    assert not published.joints
    assert all(published.imus)


@pytest.mark.parametrize("back", [0.1, 1.0, 1.9])
def test_a_clock_that_is_set_back_loses_the_angles(back):
    """Samples that seem to be earlier would be passed over, and the turn in them with them."""
    published = Published()
    published.measure(120)
    bench = published.bench
    published.joints.clear()
    bench.now -= back
    published.measure(1, link_rates=[0.5] * N)
    bench.client.ask_who(1e9)
    published.measure(round(60 * back) + 60, link_rates=[0.5] * N)  # never at rest
    assert not published.joints


class StumblingClock(Clock):
    """The processor is taken away before every third reading."""

    readings = 0

    def now(self):
        self.readings += 1
        if self.readings % 3 == 0:
            time.sleep(0.02)
        return super().now()


def test_stamps_are_even_where_the_processor_is_taken_away():
    published = Published()
    published.streams._clock = StumblingClock()
    published.measure(50)
    stamps = np.array([nanoseconds(message.header.stamp) for message in published.imus[0]]) / NANOSECONDS
    assert len(stamps) == 50
    np.testing.assert_allclose(np.diff(stamps), 1 / 60, atol=0.005)
