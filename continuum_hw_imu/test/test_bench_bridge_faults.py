"""The node at an emulated bench while things go wrong: it says so, tells no wrong angle, and lets the cables go."""

import re
import signal
import subprocess
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from ament_index_python.packages import get_package_prefix
from emulated_bench import (
    Bridge,
    LatencyProbe,
    assert_no_wrong_angle,
    bridge_at,
    emulated_bench,
    save_true_calibration,
    skip_if_busy,
    stopped_again_and_again,
)
from harness import NodeProcess, Probe, ended_in_any_case
from test_bench_bridge_node import ROW

from continuum_hw_imu.bench_bridge import AUTOSTART_PERIOD
from continuum_hw_imu.protocol.messages import GuardState, ReceiverLimits
from continuum_manipulator.nodekit.stamps import NANOSECONDS, nanoseconds

pytestmark = pytest.mark.ros

LIMITS = ReceiverLimits()
"""The emulated bench's."""


@pytest.fixture(scope="module")
def probe(domain):
    with Probe(domain) as probe:
        yield probe


@pytest.fixture(scope="module")
def latency_probe(probe):
    return LatencyProbe(probe)


@pytest.fixture(scope="module")
def calibration(tmp_path_factory):
    return save_true_calibration(tmp_path_factory.mktemp("calibration") / "sensors.yaml")


@pytest.fixture
def bridge_here(domain, latency_probe, probe, bench, calibration):
    """A function that starts a bridge at the bench, calibrated, and active by default."""

    @contextmanager
    def bridge_here(**parameters):
        probe.wait_until(lambda: not bench.status["open"], "the port is free")
        given = {"calibration": calibration, "keep_bias": True, "autostart": "activate", **parameters}
        with bridge_at(latency_probe, bench, domain, **given) as bridge:
            yield bridge

    return bridge_here


@pytest.fixture
def pulling(bridge_here):
    """An active bridge that pulls one cable by 8 N."""
    with bridge_here() as bridge:
        bridge.wait_for_joints()
        pull(bridge)
        yield bridge


def pull(bridge: Bridge) -> None:
    bridge.pull([8.0, 0.0], lambda: bridge.bench.status["set_points"][0] == pytest.approx(8.0, abs=0.01))


def go_on(bridge: Bridge, lasts: float) -> None:
    """Command on for so long by the emulator's clock."""
    end = bridge.bench.status["time"] + lasts
    bridge.command_until([8.0, 0.0], lambda: bridge.bench.status["time"] > end)


def slack_time_after(bench, instant: float) -> float:
    """How long after an instant of this machine's clock all set points are zero for good [s]."""
    truth = bench.truth()
    tight = truth["monotonic_s"][truth["set_point"].any(axis=1)]
    return max(0.0, tight[-1] - instant)


def release_begins(bench) -> float:
    """When the bench last began to let the cables go, by this machine's clock [s]."""
    truth = bench.truth()
    return truth["monotonic_s"][truth["state"] == GuardState.FOLLOWING][-1]


@pytest.mark.parametrize(
    ("number", "cause"),
    [(signal.SIGKILL, "LINK_LOST"), (signal.SIGSTOP, "HEARTBEATS_STOPPED")],
    ids=["killed", "hangs"],
)
def test_cables_are_let_go_when_the_bridge_dies(pulling, number, cause):
    """How soon is measured by `make bench-link`."""
    bench = pulling.bench
    pull(pulling)
    pulling.node.send(number)
    pulling.probe.wait_until(lambda: not np.any(bench.truth()["set_point"][-1]), "slack")
    if bench.status["cause"] == "RELEASED":
        skip_if_busy("the bridge let go before it died")
    assert bench.status["cause"] == cause
    assert slack_time_after(bench, release_begins(bench)) <= LIMITS.slack_time + 2 * ROW
    assert not bench.status["claimed"]


def test_unplugging_ends_tension_and_streaming_resumes(pulling):
    bench, probe = pulling.bench, pulling.probe
    bench.tell("unplug for=1000")
    instant = bench.status["monotonic"]
    pulling.wait_for_state("inactive")
    pulling.wait_for_level("link", "ERROR", "does not exist")
    assert slack_time_after(bench, instant) <= LIMITS.slack_time + ROW
    for subject in ("angles", "clock", "tension"):
        pulling.wait_for_level(subject, "STALE", "last received values: ")
    answer = pulling.call("zero")
    assert not answer.success
    assert "does not exist" in answer.message
    bench.tell("clear")
    probe.wait_until(lambda: bench.status["port"], "the port's return")
    probe.wait_until(lambda: pulling.diagnostic("link")["level"] in ("OK", "WARN"), lambda: pulling.diagnostic("link"))
    pulling.command_until([8.0, 0.0], lambda: probe.count(pulling.name, "dropped: not active") > 0)
    assert not any(bench.status["set_points"])
    pulling.activate()
    before = len(pulling.imus[0])
    pulling.wait_for_joints()
    pull(pulling)
    assert len(pulling.imus[0]) > before
    assert_no_wrong_angle(pulling, pulling.joints)


def test_a_bench_that_begins_again_is_greeted_again(pulling):
    bench = pulling.bench
    bench.tell("reboot")
    pulling.node.wait_for_line("fell back to inactive, cables slack")
    assert not any(bench.status["set_points"])
    pulling.joints.clear()
    pulling.wait_for_joints()
    assert_no_wrong_angle(pulling, pulling.joints)
    pull(pulling)


LINE_FAULTS = {
    "damage share=0.1 for=1000": "frames damaged",
    "damage share=0.2 for=1000 way=down": "frames that the bench found damaged",
}


@pytest.mark.parametrize("order", LINE_FAULTS)
def test_a_bad_line_is_reported_and_survived(pulling, order):
    pulling.joints.clear()
    pulling.bench.tell(order)

    def reported() -> bool:
        link = pulling.diagnostic("link")
        return int(link.get(LINE_FAULTS[order], 0)) > 0 and link["level"] in ("WARN", "ERROR")

    pulling.command_until([8.0, 0.0], reported)
    go_on(pulling, 1.0)
    pulling.bench.tell("clear")
    pull(pulling)
    pulling.wait_for_joints()
    assert_no_wrong_angle(pulling, pulling.joints)
    assert pulling.bench.status["largest_set_point"] < 8.01  # what is pulled here


def test_a_line_without_a_whole_frame_is_silent_and_no_tension_comes_back_by_itself(pulling):
    """Bytes come all the time, and the bench hears the bridge."""
    bench, probe = pulling.bench, pulling.probe
    bench.tell("damage share=1 for=1000")
    pulling.command_until([8.0, 0.0], lambda: pulling.state == "inactive")
    pulling.node.wait_for_line("fell back to inactive, cables slack: the bench is silent for")
    probe.wait_until(lambda: int(pulling.diagnostic("link").get("times opened", 0)) > 1, "the port, opened again")
    bench.tell("clear")
    probe.wait_until(lambda: pulling.diagnostic("link")["level"] in ("OK", "WARN"), lambda: pulling.diagnostic("link"))
    go_on(pulling, 0.5)
    assert pulling.state == "inactive"
    assert not any(bench.status["set_points"])
    pull(pulling)


def test_late_frames_have_the_stamps_of_their_measurement(pulling):
    """All of them: the frames before tell the clock, and until its error grows too large there are joint states."""
    pulling.joints.clear()
    pulling.bench.tell("late by=0.2 for=1000")
    begin = pulling.bench.status["monotonic"]
    pulling.command_until([8.0, 0.0], lambda: "ms late" in pulling.diagnostic("clock")["message"])
    go_on(pulling, 0.5)
    end = pulling.bench.status["monotonic"]
    pulling.bench.tell("clear")
    pull(pulling)
    pulling.wait_for_joints(60)
    late = sum(begin < pulling.monotonic(message) < end for message in pulling.joints)
    assert_no_wrong_angle(pulling, pulling.joints)
    if late < 10:
        skip_if_busy(f"{late} joint states of late frames")


def test_a_bridge_without_a_processor_publishes_no_wrong_angle(bridge_here):
    """From its start on it is stopped again and again, until it has published angles of an arm that moves."""
    with bridge_here() as bridge, stopped_again_and_again(bridge.node.process.pid, 0.03, 0.03, seed=1):

        def moves() -> int:
            return sum(np.abs(message.velocity).max() > 0.3 for message in bridge.joints)

        for _ in range(20):  # a busy machine adds to it
            if bridge.state != "active":
                bridge.change("activate")
            bridge.let_hand_move("hand bend=60 over=0.3 hold=1", 1.5)
            if moves() > 60:
                break
        assert_no_wrong_angle(bridge, bridge.joints)
        if moves() <= 60:
            skip_if_busy(f"{moves()} joint states of a moving arm")


def lose_angles(pulling, order: str) -> float:
    """Give an order by which the angles are lost, until the node becomes inactive for that; return when [s].

    Again, where a busy machine makes it inactive before.
    """
    bench, node = pulling.bench, pulling.node
    for _ in range(10):
        said = len(node.stderr)
        bench.tell(order)
        lost = bench.status["monotonic"]
        pulling.command_until([8.0, 0.0], lambda: pulling.state == "inactive")
        pulling.probe.wait_until(lambda said=said: "fell back to inactive" in node.stderr[said:], lambda: node.stderr)
        if "fell back to inactive, cables slack: the angles are lost since " in node.stderr[said:]:
            return lost
        bench.tell("clear")
        pull(pulling)
    raise AssertionError(node.stderr)


def assert_commands_are_refused(pulling):
    """An active node whose angles are lost pulls no cable, from its activation on."""
    pulling.probe.wait_until(lambda: not np.any(pulling.bench.truth()["set_point"][-1]), "slack cables")
    dropped = "dropped: angles lost"
    before, begin = pulling.probe.count(pulling.name, dropped), pulling.bench.status["monotonic"]
    pulling.activate()
    pulling.command_until([8.0, 0.0], lambda: pulling.probe.count(pulling.name, dropped) > before + 3)
    truth = pulling.bench.truth()
    assert not np.any(truth["set_point"][truth["monotonic_s"] > begin])


def test_a_lost_sensor_is_reported_once_and_the_cables_are_let_go(pulling, record_property):
    bench, node = pulling.bench, pulling.node
    lost = lose_angles(pulling, "drop sensor=3 for=1000")
    assert re.search(
        r"the angles are lost since \d+\.\d\d s: .*(sensor 3 is missing|no frames of the sensors)", node.stderr
    )
    begins = release_begins(bench)
    if (
        pulling.joints
    ):  # 1 s after the last angles that were known; on a busy machine these may be from before the order
        known = pulling.monotonic_of(nanoseconds(pulling.joints[-1].header.stamp) / NANOSECONDS)
        assert begins >= known + 0.9
    pulling.probe.wait_until(lambda: not np.any(bench.truth()["set_point"][-1]), "slack")
    assert slack_time_after(bench, begins) <= LIMITS.slack_time + 2 * ROW
    assert_commands_are_refused(pulling)
    bench.tell("clear")
    node.wait_for_line("imu 3 is back: DOT-3 was lost for ")
    for returns in (2, 3):  # within a burst of losses, too
        bench.tell("drop sensor=3 for=0.3")
        pulling.probe.wait_until(lambda n=returns: node.stderr.count("imu 3 is back") == n, lambda: node.stderr)
    pulling.wait_for_joints()
    pull(pulling)
    assert_no_wrong_angle(pulling, pulling.joints)
    line = next(line for line in node.stderr.splitlines() if "imu 3 is lost" in line)
    assert "no data of DOT-3 for 0.1" in line
    said = pulling.monotonic_of(float(re.search(r"\[(\d+\.\d+)\]", line)[1]))
    record_property("from loss to line [s]", round(float(said - lost), 3))
    record_property("from loss to release [s]", round(float(begins - lost), 3))
    print(f"from loss to line {said - lost:.3f} s, to release {begins - lost:.3f} s")


def test_cables_are_let_go_when_no_frames_of_the_sensors_come(pulling):
    """While the bench reports its state and its tensions."""
    bench, node = pulling.bench, pulling.node
    lose_angles(pulling, "mute for=1000")
    node.wait_for_line("all sensors are lost")
    assert re.search(r"the angles are lost since \d+\.\d\d s: no frames of the sensors", node.stderr)
    pulling.wait_for_level("angles", "ERROR", "no frames of the sensors")
    assert_commands_are_refused(pulling)
    bench.tell("clear")
    pulling.wait_for_joints()
    pull(pulling)


def test_the_start_of_an_emulated_bench_has_no_warnings(domain, latency_probe, calibration, tmp_path):
    """As of a launch: all at once, and the port comes when the emulator is ready."""
    port = tmp_path / "port"
    words = {"name": "early", "parameters": {"port": port, "calibration": calibration, "autostart": "activate"}}
    early = NodeProcess("continuum_hw_imu", "bench_bridge", domain, **words)
    with ended_in_any_case(early), emulated_bench(domain, tmp_path):
        early.wait_for_line(f"waiting: {port} does not exist")
        early.wait_for_line("bench_emulator 0.1.0 at")
        early.wait_for_line("stays inactive: not calibrated: no bias; call ~/calibrate_bias (at rest)")
        assert early.stop() == 0
        assert all(line.startswith("[INFO]") for line in early.stderr.splitlines()), early.stderr


def test_a_stop_at_the_bench_stops_the_node(pulling, domain, latency_probe, calibration):
    """Seen as the node's own: it is latched, and reset by its service."""
    assert pulling.call("stop").success
    pulling.wait_for_state("inactive")
    pulling.node.close()
    with bridge_at(latency_probe, pulling.bench, domain, calibration=calibration, keep_bias=True) as after:
        after.node.wait_for_line("stopped: by the bench")
        assert not after.change("activate")
        after.wait_for_success("reset_stop")
        after.activate()


def test_what_was_stopped_becomes_active_by_a_persons_word_alone(bridge_here, probe, bench):
    """Even a node that had yet to begin by itself when it was stopped."""
    bench.tell("unplug for=1000")
    with bridge_here() as bridge:
        bridge.node.wait_for_line("does not exist")
        assert bridge.call("stop").success
        bench.tell("clear")
        probe.wait_until(lambda: bench.status["port"], "the port's return")
        bridge.configure()
        bridge.wait_for_success("reset_stop")
        go_on(bridge, 3 * AUTOSTART_PERIOD)
        assert bridge.state == "inactive"
        assert not any(bench.status["set_points"])
        assert bridge.node.stop() == 0


def test_the_bias_of_a_file_is_of_another_day(bridge_here):
    """With hands still on the arm, the end of the calibration does not activate the node, whatever `autostart`."""
    with bridge_here(keep_bias=False) as bridge:
        bridge.wait_for_level("angles", "ERROR", "not calibrated: no bias")
        assert not bridge.change("activate")
        bridge.wait_for_success("calibrate_bias")
        go_on(bridge, 3 * AUTOSTART_PERIOD)
        assert bridge.state == "inactive"
        (line,) = [line for line in bridge.node.stderr.splitlines() if "stays inactive: not calibrated" in line]
        assert line.endswith("; then activate the node")
        bridge.wait_for_joints()
        assert_no_wrong_angle(bridge, bridge.joints)
        assert bridge.node.stop() == 0


def test_a_second_emulator_takes_nothing_from_the_first(domain, bench, tmp_path):
    folder = bench.port.parent
    for words, diagnostic in (
        (("--link", bench.port), "exists already and refers to /dev/pts/"),
        (("--link", tmp_path / "other", "--control", folder / "control"), "belongs to another running emulator"),
    ):
        again = NodeProcess("continuum_hw_imu", "bench_emulator", domain, arguments=tuple(map(str, words)))
        with ended_in_any_case(again):
            assert again.exit_code() == 2
            assert diagnostic in again.stderr
    assert bench.port.exists()
    assert bench.status["port"]


def test_orders_are_given_by_a_command(bench, capfd):
    command = [Path(get_package_prefix("continuum_hw_imu")) / "lib/continuum_hw_imu/bench_order"]
    control = ["--control", bench.port.parent / "control"]
    assert subprocess.run([*command, *control, "clear", "status"], timeout=60).returncode == 0
    assert '"set_points"' in capfd.readouterr().out
    assert subprocess.run([*command, *control, "explode"], timeout=60).returncode == 1
    assert subprocess.run([*command, "--control", "/nowhere", "status"], timeout=60).returncode == 2
    assert capfd.readouterr().err.endswith("/nowhere: No such file or directory; is the emulator running?\n")


def test_an_empty_battery_is_reported(pulling):
    pulling.bench.tell("battery sensor=2 percent=3")
    pulling.wait_for_level("imu 2", "ERROR", "battery at 3 %")
    pulling.bench.tell("battery sensor=2 percent=90")
