"""An emulated bench as a process, told over its second channel what to do, and the node at its port."""

import json
import os
import signal
import socket
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, suppress
from pathlib import Path

import numpy as np
import pytest
from harness import NodeProcess, Probe, ended_in_any_case, wait_until
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from scipy.interpolate import CubicHermiteSpline
from sensor_msgs.msg import Imu, JointState
from std_srvs.srv import Trigger

from continuum.dynamics.model_file import load_model
from continuum.inertial.calibration_values import Calibration, save_calibration
from continuum_hw_imu.emulator.bench import BenchSettings
from continuum_hw_imu.emulator.link_motion import gravity
from continuum_hw_imu.emulator.sensor_model import SensorModel
from continuum_hw_imu.emulator.truth_file import read_truth
from continuum_hw_imu.sensor_quality import SensorQuality
from continuum_manipulator.nodekit.qos import STREAM
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds
from continuum_manipulator.nodekit.two_clocks import read_together
from continuum_msgs.msg import CableStates

COMMAND_PERIOD = 1 / 30  # s
FARTHEST = np.radians(1.5)
"""A single angle that is further off the truth is wrong: five times what the sensors may err at rest."""
TOO_BUSY = 60.0  # s; without known times of the samples
ASK_AGAIN = 3.0  # s; longer than the bridge waits for the bench
CABLES = ["section_1_cable_1", "section_1_cable_2"]
N_SENSORS = 5


class Shared:
    """What tests share until one fails. Use as a context.

    Args:
        make: returns a context of the shared.
    """

    def __init__(self, make: Callable[[], AbstractContextManager]) -> None:
        self._make, self._stack = make, ExitStack()
        self._kept = None

    def __enter__(self) -> "Shared":
        return self

    def __exit__(self, *_) -> None:
        self._kept = None
        self._stack.close()

    def get(self):
        if self._kept is None:
            self._kept = self._stack.enter_context(self._make())
        return self._kept

    def replace(self) -> None:
        """End it, in whatever state it is; the next test gets another."""
        self._kept = None
        with suppress(Exception):  # of what failed already
            self._stack.close()


class EmulatedBench:
    """The emulator. Its files are in ``folder``: port, control, truth.csv."""

    def __init__(self, domain: int, folder: Path, *options: str) -> None:
        self.port, self.truth_file = folder / "port", folder / "truth.csv"
        self._control = folder / "control"
        words = ["--link", self.port, "--control", self._control, "--truth", self.truth_file, *options]
        self.process = NodeProcess("continuum_hw_imu", "bench_emulator", domain, arguments=tuple(map(str, words)))
        with ExitStack() as undone:
            undone.callback(self.process.close)
            self._socket = undone.enter_context(socket.socket(socket.AF_UNIX))
            self._socket.settimeout(30.0)
            wait_until(lambda: self.port.exists() and self._is_connected(), lambda: f"port; {self.process.stderr}")
            undone.pop_all()
        self._answers = self._socket.makefile("r")

    def _is_connected(self) -> bool:
        """A channel's file is there a moment before anybody listens."""
        with suppress(FileNotFoundError, ConnectionRefusedError):
            self._socket.connect(str(self._control))
            return True
        return False

    def tell(self, order: str) -> dict:
        self._socket.sendall(f"{order}\n".encode())
        answer = json.loads(self._answers.readline())
        assert answer["ok"], answer
        return answer

    @property
    def status(self) -> dict:
        return self.tell("status")

    def truth(self) -> dict[str, np.ndarray]:
        """What really happened so far, as of `read_truth`."""
        return read_truth(self.truth_file)

    def close(self) -> None:
        self._answers.close()
        self._socket.close()
        self.process.close()


class LatencyProbe:
    """A probe on the topics of bridges that come one after the other, and the one that commands them by a topic."""

    def __init__(self, probe: Probe, commands: str = "cable_tension_cmd") -> None:
        self.probe = probe
        self.joints = probe.hear(JointState, "joint_states")
        self.cables = probe.hear(CableStates, "cable_states")
        self.imus = [probe.hear(Imu, f"imu_{k}/data_raw") for k in range(1, N_SENSORS + 1)]
        self.say = probe.node.create_publisher(CableStates, commands, STREAM).publish
        self.bridges = 0

    def clear(self) -> None:
        for received in (self.joints, self.cables, *self.imus):
            received.clear()


class Bridge:
    """The node at an emulated bench. Each has a name of its own, lest one that was killed be asked in its place."""

    def __init__(
        self,
        latency_probe: LatencyProbe,
        bench: EmulatedBench,
        domain: int,
        arguments: Sequence[str] = (),
        **parameters,
    ) -> None:
        latency_probe.bridges += 1
        latency_probe.clear()
        self.probe, self.bench, self.name = latency_probe.probe, bench, f"bench_bridge_{latency_probe.bridges}"
        self.joints, self.cables, self.imus, self._say = (
            latency_probe.joints,
            latency_probe.cables,
            latency_probe.imus,
            latency_probe.say,
        )
        parameters = {"port": bench.port, "rest_time": 1.5, **parameters}
        self.node = NodeProcess(
            "continuum_hw_imu",
            "bench_bridge",
            domain,
            name=self.name,
            parameters=parameters,
            arguments=tuple(arguments),
        )
        self._clients = {
            name: latency_probe.probe.node.create_client(kind, f"{self.name}/{name}")
            for kind, names in {
                Trigger: ("zero", "calibrate_bias", "find_axes", "release", "stop", "reset_stop"),
                ChangeState: ("change_state",),
                GetState: ("get_state",),
            }.items()
            for name in names
        }

    def call(self, name: str, request=None):
        """Asked again where the answer is lost, as while nodes still find each other."""
        client, asked, ask_again = self._clients[name], [], 0.0
        self.probe.wait_until(client.service_is_ready, lambda: f"service {name}; {self.node.stderr}")

        def answered() -> bool:
            nonlocal ask_again
            if time.monotonic() > ask_again:
                asked.append(client.call_async(request or client.srv_type.Request()))
                ask_again = time.monotonic() + ASK_AGAIN
            return any(future.done() for future in asked)

        self.probe.wait_until(answered, lambda: f"answer of {name}; {self.node.stderr}")
        return next(future.result() for future in asked if future.done())

    @property
    def state(self) -> str:
        return self.call("get_state").current_state.label

    def change(self, transition: str) -> bool:
        """Whether a transition was carried out; one whose answer was lost is refused the second time."""
        number = getattr(Transition, f"TRANSITION_{transition.upper()}")
        return self.call("change_state", ChangeState.Request(transition=Transition(id=number))).success

    def configure(self) -> None:
        """Configure, again where the bench just then does not answer."""
        self.probe.wait_until(
            lambda: self.state == "inactive" or self.change("configure"), lambda: f"inactive; {self.node.stderr}"
        )

    def activate(self) -> None:
        """Activate, again where the bench just then is silent or does not answer, as on a busy machine."""
        self.probe.wait_until(
            lambda: self.state == "active" or self.change("activate"), lambda: f"active; {self.node.stderr}"
        )

    def deactivate(self) -> None:
        """Deactivate, unless the node has become inactive by itself, and wait for slack cables."""
        if self.state == "active":
            self.change("deactivate")
        self.wait_for_state("inactive")
        self.probe.wait_until(lambda: not any(self.bench.status["set_points"]), "slack cables")

    def wait_for_joints(self, number: int = 5) -> None:
        """Wait for so many more joint states, of an active node."""
        before = len(self.joints)
        self.wait_while_active(
            lambda: len(self.joints) >= before + number, lambda: f"joint states; {self.diagnostic('angles')}"
        )

    def wait_while_active(self, condition, what) -> None:
        """Wait for what an active node does, and activate it again where it loses its claim, as on a busy machine."""

        def holds() -> bool:
            if condition():
                return True
            if self.state != "active":
                self.activate()
            return bool(condition())

        self._wait_if_not_busy(holds, what)

    def _wait_if_not_busy(self, condition, what) -> None:
        """Wait; where the machine is too busy for it, skip the test if all angles so far were right."""
        try:
            self.probe.wait_until(condition, what, TOO_BUSY)
        except AssertionError as error:
            assert_no_wrong_angle(self, self.joints)
            if is_busy():
                pytest.skip(f"this machine is too busy: {error}")
            self.probe.wait_until(condition, what)

    def wait_for_state(self, label: str) -> None:
        self.probe.wait_until(lambda: self.state == label, lambda: f"{label}; {self.node.stderr}")

    def diagnostic(self, subject: str) -> dict[str, str]:
        return self.probe.report(f"{self.name}: {subject}")

    def wait_for_level(self, subject: str, level: str, words: str = "") -> None:
        self.probe.wait_until(
            lambda: self.diagnostic(subject).get("level") == level and words in self.diagnostic(subject)["message"],
            lambda: f"{level} {words!r} of {subject}, which tells {self.diagnostic(subject)}",
        )

    def command(self, effort, age: float = 0.0) -> None:
        now = self.probe.node.get_clock().now().nanoseconds - round(age * NANOSECONDS)
        message = CableStates(name=CABLES, effort=effort)
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(now, NANOSECONDS)
        self._say(message)

    def monotonic(self, message) -> float:
        """When what a message tells of was measured, by this machine's monotonic clock [s]."""
        return self.monotonic_of(nanoseconds(message.header.stamp) / NANOSECONDS)

    def monotonic_of(self, stamp: float) -> float:
        """A ROS time [s] by this machine's monotonic clock [s]."""
        instant, now = read_together(time.monotonic, lambda: self.probe.node.get_clock().now().nanoseconds)
        return instant + (stamp - now / NANOSECONDS)

    def command_until(self, effort, until) -> None:
        """Command tensions until ``until()``."""
        due = time.monotonic()

        def done() -> bool:
            nonlocal due
            if time.monotonic() >= due:
                self.command(effort)
                due = time.monotonic() + COMMAND_PERIOD
            return until()

        self.probe.wait_until(done, lambda: f"what was commanded for; {self.bench.status}; {self.node.stderr}")

    def pull(self, effort, until) -> None:
        """Command tensions until ``until()``, and activate the node again where it drops them.

        The bench lets go of a commander that was silent, as on a machine that was busy for long, also before this
        begins.
        """
        due = time.monotonic()

        def dropped() -> int:
            return self.probe.count(self.name, "dropped: not active")

        seen = dropped()

        def done() -> bool:
            nonlocal seen, due
            if time.monotonic() >= due:
                self.command(effort)
                due = time.monotonic() + COMMAND_PERIOD
            if dropped() > seen:
                seen = dropped()
                self.activate()
            return until()

        self._wait_if_not_busy(done, lambda: f"what is pulled for; {self.bench.status}; {self.node.stderr}")

    def calibrate(self) -> list[str]:
        """At rest, straight, and after a bend towards cable 1; what the services answered."""
        said = [self.wait_for_success("calibrate_bias"), self.wait_for_success("zero")]
        self.let_hand_move("hand bend=60 over=1 hold=0.3", 3.0)
        return [*said, self.wait_for_success("find_axes")]

    def let_hand_move(self, order: str, lasts: float) -> None:
        """Give the order, and listen until it is over by the emulator's own clock."""
        self.bench.tell(order)
        end = self.bench.status["time"] + lasts
        self.probe.wait_until(lambda: self.bench.status["time"] >= end, order)

    def wait_for_success(self, name: str) -> str:
        """Call a service until it does what it is for, as after enough rest."""
        answers = [self.call(name)]

        def succeeded() -> bool:
            if not answers[-1].success:
                answers.append(self.call(name))
            return answers[-1].success

        self.probe.wait_until(succeeded, lambda: f"{name}: {answers[-1].message}")
        return answers[-1].message


def angles_and_truth(bridge, joints):
    """Joint angles as published, (n, n_joints), and the true ones at their stamps, each [rad].

    Between two rows of the truth, 17 ms apart, by angles and rates: a line would be half a degree off where an arm is
    let go.
    """
    truth = bridge.bench.truth()
    at = np.array([bridge.monotonic(message) for message in joints])
    inside = (at > truth["monotonic_s"][0]) & (at < truth["monotonic_s"][-1])
    real = CubicHermiteSpline(truth["monotonic_s"], truth["theta"], truth["theta_rate"])(at[inside])
    return np.array([message.position[1:-1] for message in joints])[inside], real


def rms_degrees(difference) -> float:
    return float(np.degrees(np.sqrt(np.mean(difference**2))))


def assert_no_wrong_angle(bridge: Bridge, joints) -> None:
    if not joints:
        return  # as of a starved bridge
    off = np.abs(np.subtract(*angles_and_truth(bridge, joints)))
    assert off.max() < FARTHEST, np.degrees(off.max(axis=1))


def is_busy() -> bool:
    """Whether twice as many processes want a processor as there are."""
    return os.getloadavg()[0] > 2.0 * len(os.sched_getaffinity(0))


def skip_if_busy(reason: str) -> None:
    """Skip the test where the machine is too busy for it; fail elsewhere."""
    load = f"load {os.getloadavg()[0]:.1f} on {len(os.sched_getaffinity(0))} processors"
    if is_busy():
        pytest.skip(f"{reason}; {load}")
    pytest.fail(f"{reason}; {load}")


def save_true_calibration(file: Path) -> Path:
    """Write the calibration that the sensors of an emulated bench have by default, with the bias of its start."""
    sensors = SensorModel(N_SENSORS, SensorQuality(), np.random.default_rng(BenchSettings().seed))
    upwards = -gravity(load_model("lamecc_prototype.yaml"))
    calibration = Calibration(
        bias=sensors._rate_bias,
        axis=np.array([mounting.apply([0.0, 1.0, 0.0]) for mounting in sensors.mountings]),
        zero=np.array([mounting.apply(upwards) for mounting in sensors.mountings]) + sensors._force_bias,
        sources=("as emulated",) * N_SENSORS,
    )
    save_calibration(calibration, file)
    return file


@contextmanager
def emulated_bench(domain: int, folder: Path, *options: str):
    bench = EmulatedBench(domain, folder, *options)
    try:
        yield bench
        assert bench.process.running, bench.process.stderr
    finally:
        bench.close()


@contextmanager
def bridge_at(
    latency_probe: LatencyProbe, bench: EmulatedBench, domain: int, arguments: Sequence[str] = (), **parameters
):
    bridge = Bridge(latency_probe, bench, domain, arguments, **parameters)
    with ended_in_any_case(bridge.node):
        yield bridge


@contextmanager
def stopped_again_and_again(process, stopped, runs, seed):
    """During the block stop a process for up to ``stopped`` [s] and let it run for up to ``runs`` [s], in turn."""
    over, random = threading.Event(), np.random.default_rng(seed)

    def stop_and_go():
        with suppress(ProcessLookupError):
            while not over.is_set():
                os.kill(process, signal.SIGSTOP)
                over.wait(random.uniform(0.0, stopped))
                os.kill(process, signal.SIGCONT)
                over.wait(random.uniform(0.0, runs))

    stopper = threading.Thread(target=stop_and_go)
    stopper.start()
    try:
        yield
    finally:
        over.set()
        stopper.join()
